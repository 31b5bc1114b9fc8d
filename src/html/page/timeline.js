// When each stage ran, and what the cache saved.

function bar(stage, begin, span) {
  const style = `left:${100 * begin / span}%;width:${Math.max(0.15, 100 * stage.wall / span)}%`;
  return make('div', { class: 'track' }, make('i', { style, class: stage.outcome }));
}

// Stages of this build stand where they ran; those from the cache at the left, as long as they took once.
function timeline_section(timings) {
  if (!timings || !timings.stages.length) return null;
  const begin = (s) => s.begin ?? 0;
  const span = Math.max(1e-6, ...timings.stages.map((s) => begin(s) + s.wall));
  const ran = timings.stages.filter((s) => s.outcome === 'ran');
  const hits = timings.stages.filter((s) => s.outcome === 'hit');
  const sum = (list) => list.reduce((total, s) => total + s.cpu, 0);
  const columns = [
    ['Stage', (s) => make('span', null, s.stage, make('em', null, s.subject ? ` ${s.subject}` : ''))],
    ['', (s) => make('span', { class: `tag ${s.outcome === 'hit' ? 'good' : 'quiet'}` },
      s.outcome === 'hit' ? 'from the cache' : s.outcome)],
    ['Time', (s) => bar(s, begin(s), span), 'wide'],
    ['Took', (s) => seconds_text(s.wall), 'number'],
    ['Processor', (s) => seconds_text(s.cpu), 'number'],
    ['Memory', (s) => size_text(s.peak_memory), 'number'],
  ];
  const slow = [...timings.stages].sort((a, b) => b.wall - a.wall).slice(0, 12);
  const text = `${count_text(ran.length, 'stage')} ran (${seconds_text(sum(ran))} of processor time), ` +
    `${grouped(hits.length)} came from the cache (${seconds_text(sum(hits))} saved).`;
  const rest = timings.stages.length - slow.length;
  const order = slow.sort((a, b) => begin(a) - begin(b));
  return section('timeline', 'Stages and cache', [make('p', null, text), table(columns, order),
    rest > 0 ? details(`All ${timings.stages.length} stages`, table(columns, timings.stages)) : null]);
}
