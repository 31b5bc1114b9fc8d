// The clock of the clips: a choice, a button, a slider.

class Player {
  constructor(view, rows) {
    this.view = view;
    this.clip = '';
    this.time = 0;
    this.is_playing = false;
    this.speed = 1;
    this.choice = make('select', { id: 'clip', 'aria-label': 'Clip', onchange: () => this.start(this.choice.value) },
      make('option', { value: '' }, 'Rest pose'),
      view.clip_names().map((name) => make('option', { value: name }, name)));
    this.button = make('button', { id: 'play', class: 'play', onclick: () => this.toggle() }, '▶');
    this.slider = make('input', { type: 'range', min: 0, max: 1000, value: 0, 'aria-label': 'Time',
      oninput: () => this.seek(this.slider.value / 1000 * this.duration()) });
    this.label = make('output', null);
    this.pace = make('select', { 'aria-label': 'Speed', onchange: () => { this.speed = Number(this.pace.value); } },
      ['0.25', '0.5', '1', '2'].map((x) => make('option', { value: x, selected: x === '1' }, `${x} ×`)));
    this.bar = make('div', { class: 'player' }, this.button, this.choice, this.slider, this.label, this.pace);
    this.rows = rows ?? new Map();  // of the table of clips
    this.show();
  }

  duration() { return this.clip ? this.view.duration(this.clip) : 0; }

  // From its beginning, playing.
  start(clip) {
    this.choose(clip, 0);
    if (clip) this.play();
  }

  // Stands at a time of a clip.
  choose(clip, time) {
    this.pause();
    this.clip = this.view.clip_names().includes(clip) ? clip : '';
    this.seek(time);
    this.on_clip?.();
  }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.duration());
    this.show();
  }

  toggle() {
    if (this.is_playing) this.pause();
    else if (this.clip) this.play();
    else this.start(this.view.clip_names()[0] ?? '');
  }

  play() {
    this.is_playing = true;
    this.last = null;
    const step = (now) => {
      if (!this.is_playing) return;
      if (this.last !== null) {
        const duration = this.duration();
        this.time += this.speed * (now - this.last) / 1000;
        if (this.time > duration) this.time = duration > 0 ? this.time % duration : 0;
        this.show();
      }
      this.last = now;
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    this.show();
  }

  pause() {
    this.is_playing = false;
    this.show();
  }

  show() {
    this.view.at(this.clip, this.time);
    const duration = this.duration();
    this.choice.value = this.clip;
    this.button.textContent = this.is_playing ? '❚❚' : '▶';
    this.button.setAttribute('aria-label', this.is_playing ? 'Pause' : 'Play');
    this.slider.disabled = duration === 0;
    this.slider.value = duration > 0 ? 1000 * this.time / duration : 0;
    this.label.textContent = this.clip ? `${this.time.toFixed(2)} / ${duration.toFixed(2)} s` : '';
    for (const [name, row] of this.rows) row.classList.toggle('chosen', name === this.clip);
    Object.assign(document.body.dataset, { clip: this.clip, time: this.time.toFixed(3) });
  }
}
