// The clips, where their completed motion comes from, and what goes wrong in them.

function completed_text(clip) {
  const sources = new Map();
  for (const run of clip.completed_from) sources.set(run.clip, (sources.get(run.clip) ?? 0) + run.frames);
  const all = [...sources.values()].reduce((a, b) => a + b, 0);
  return [...sources].sort((a, b) => b[1] - a[1]).map(([name, frames]) =>
    `${name} ${percent_text(frames / all, 0)}`).join(', ') || '–';
}

function fault_text(posed) {
  const parts = [];
  if (posed.intersections) parts.push(count_text(posed.intersections, 'crossing'));
  if (posed.folds) parts.push(count_text(posed.folds, 'fold'));
  return parts.length ? `${parts.join(', ')} at ${posed.worst_time.toFixed(2)} s` : 'none';
}

// `play`: (clip, time) -> shows it; rows by the clip's name come back for the player.
function clips_section(report, play) {
  const link = (clip, time, text, hint) => make('button', { class: 'link', title: hint,
    onclick: () => play(clip.name, time) }, text);
  const columns = [
    ['Clip', (c) => link(c, null, c.name, 'Play')],
    ['From', (c) => c.input],
    ['Length', (c) => `${c.duration.toFixed(2)} s`, 'number'],
    ['Plays', (c) => (c.playback === 'loop' ? 'in a loop' : 'once')],
    ['Other parts move as in', (c) => completed_text(c)],
    ['Keys', (c) => grouped(c.keys), 'number'],
    ['New faults at the worst frame', (c) => (c.posed.intersections || c.posed.folds
      ? link(c, c.posed.worst_time, fault_text(c.posed), 'Show this frame') : 'none')],
    ['Stretch', (c) => `${short_number(c.posed.stretch)} ×`, 'number'],
    ['Feet slide', (c) => `${short_number(c.posed.foot_slide)} m/s`, 'number'],
  ];
  const element = report.clips.length ? table(columns, report.clips) : null;
  const rows = new Map();
  if (element) [...element.querySelectorAll('tbody tr')].forEach((row, i) => rows.set(report.clips[i].name, row));
  return { element: section('clips', 'Clips', element), rows };
}
