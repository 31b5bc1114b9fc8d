// Two models side by side: where they differ, and by how much.

function diff_overview(diff) {
  const over = diff.findings.filter((finding) => finding.is_over);
  const worst = diff.clips.reduce((a, b) => (b.max > (a?.max ?? -1) ? b : a), null);
  return make('header', null, make('h1', null, `${diff.a.name} and ${diff.b.name}`),
    make('p', { class: 'verdict' }, over.length
      ? make('span', { class: 'tag bad' }, count_text(over.length, 'difference'))
      : make('span', { class: 'tag good' }, 'the same within the limits')),
    make('div', { class: 'facts' },
      fact(error_text(diff.geometry.max), 'surface', 'largest distance of the surfaces in the bind pose, of the diagonal'),
      fact(`${short_number(diff.geometry.normals_deg.max)}°`, 'normals', 'largest angle between normals of the same corner'),
      fact(short_number(diff.skin.max), 'weights', 'largest change of a vertex’s weights, of 2'),
      worst && fact(error_text(worst.max), `motion, in ${worst.clip}`, `at ${worst.time.toFixed(3)} s on ${worst.joint}`),
      diff.pictures.length && fact(error_text(Math.max(...diff.pictures.map((p) => p.changed))), 'picture',
        'largest share of the character’s pixels that changed'),
      fact(`× ${short_number(diff.structure.b.bytes / Math.max(1, diff.structure.a.bytes))}`, 'file size'),
      fact(`× ${short_number(diff.structure.b.keys / Math.max(1, diff.structure.a.keys))}`, 'keys')));
}

const error_text = (share) => `${short_number(100 * share)} %`;

function findings_section(diff) {
  return section('findings', 'Findings', findings_table(diff.findings));
}

function diff_clips_section(diff, play) {
  const link = (clip, time, text, hint) => make('button', { class: 'link', title: hint,
    onclick: () => play(clip.clip, time) }, text);
  const columns = [
    ['Clip', (c) => link(c, null, c.clip, 'Play')],
    ['Largest error', (c) => error_text(c.max), 'number'],
    ['at', (c) => (c.max > 0 ? link(c, c.time, `${c.time.toFixed(3)} s`, 'Show this moment') : '–'), 'number'],
    ['on', (c) => c.joint],
    ['RMS', (c) => error_text(c.rms), 'number'],
    ['Joints', (c) => error_text(c.joint_max), 'number'],
    ['Turn', (c) => `${short_number(c.joint_angle_deg)}°`, 'number'],
    ['Length', (c) => `${c.duration_a.toFixed(3)} → ${c.duration_b.toFixed(3)} s`, 'number'],
    ['Keys', (c) => `${grouped(c.keys_a)} → ${grouped(c.keys_b)}`, 'number'],
  ];
  const element = diff.clips.length ? table(columns, diff.clips) : null;
  const rows = new Map();
  if (element) [...element.querySelectorAll('tbody tr')].forEach((row, i) => rows.set(diff.clips[i].clip, row));
  return { element: section('clips', 'Clips, in % of the diagonal', element), rows };
}

// What is counted and measured on both sides: { name, a, b }.
function side_by_side(diff) {
  const { structure: { a, b }, geometry, skin } = diff;
  const rows = Object.keys(a).map((key) => ({ name: key.replaceAll('_', ' '), a: a[key], b: b[key] }));
  const of_a = skin.vertices_by_influences_a, of_b = skin.vertices_by_influences_b;
  for (let n = 0; n < Math.max(of_a.length, of_b.length); ++n)
    if (of_a[n] || of_b[n]) rows.push({ name: `vertices that follow ${count_text(n, 'joint')}`, a: of_a[n] ?? 0, b: of_b[n] ?? 0 });
  const { uv_a, uv_b } = geometry;
  if (uv_a.triangles || uv_b.triangles)
    rows.push({ name: 'UV stretch (L2)', a: uv_a.stretch, b: uv_b.stretch },
      { name: 'UV stretch, largest', a: uv_a.stretch_max, b: uv_b.stretch_max },
      { name: 'UV area used more than once, %', a: 100 * uv_a.overlap, b: 100 * uv_b.overlap });
  rows.push({ name: 'area, m²', a: geometry.area_a, b: geometry.area_b },
    { name: 'volume, m³', a: geometry.volume_a, b: geometry.volume_b });
  return rows;
}

function counts_section(diff) {
  const text = (n) => (Number.isInteger(n) ? grouped(n) : String(Number(n.toPrecision(6))));
  const columns = [['', (row) => row.name], ['A', (row) => text(row.a), 'number'], ['B', (row) => text(row.b), 'number'],
    ['', (row) => (row.a === row.b ? '' : row.a ? `× ${short_number(row.b / row.a)}` : 'new'), 'number']];
  const sentences = [...diff.structure.edits, ...diff.provenance.map((other) => `provenance, ${other}`),
    ...diff.rules.map((rule) => `glTF ${rule.severity} ${rule.code}: ${rule.a} → ${rule.b}`)];
  return section('structure', 'Structure', [table(columns, side_by_side(diff), (row) => (row.a === row.b ? null : 'changed')),
    make('p', { class: 'hint' }, `${short_number(100 * diff.geometry.unchanged)} % of the vertices are at the same place.`),
    sentences.length ? make('ul', null, sentences.map((text) => make('li', null, text))) : null]);
}

// The drawings with what differs, the most changed first.
function drawings_section(diff, drawings) {
  const figures = diff.pictures.map((picture, i) => ({ picture, source: drawings[i].source }))
    .sort((x, y) => y.picture.changed - x.picture.changed)
    .map(({ picture, source }) => make('figure', null, make('img', { src: source, alt: picture.title, loading: 'lazy' }),
      make('figcaption', null, `${picture.title}: ${error_text(picture.changed)} of the character changed, colours differ by `
        + `${error_text(picture.mean_error)} in the mean, SSIM ${picture.ssim.toFixed(4)}, outlines overlap by `
        + error_text(picture.overlap))));
  return section('pictures', 'Pictures', figures.length ? make('div', { class: 'figures pairs' }, figures) : null);
}

function bytes_of(text) {
  const decoded = atob(text), bytes = new Uint8Array(decoded.length);
  for (let i = 0; i < decoded.length; ++i) bytes[i] = decoded.charCodeAt(i);
  return bytes;
}

// Per model and primitive, a value in [0, 1] for each vertex of the file; NaN where there is no counterpart.
function error_values(diff, errors) {
  return ['a', 'b'].map((side) => {
    const steps = bytes_of(errors[side]);
    return diff[side].vertices.map((text) => Array.from(new Uint32Array(bytes_of(text).buffer),
      (v) => (steps[v] === 255 ? NaN : steps[v] / 254)));
  });
}

async function open_diff_viewer(module, diff, rows) {
  const canvas = make('canvas', { 'aria-label': 'Both models in three dimensions' });
  const stage = make('div', { class: 'stage' }, make('div', { class: 'canvas' }, canvas,
    make('span', { class: 'side', style: 'left:10px' }, `A  ${diff.a.name}`),
    make('span', { class: 'side', style: 'left:calc(50% + 10px)' }, `B  ${diff.b.name}`)));
  document.getElementById('viewer_place').replaceChildren(stage);
  const view = await module.ModelView.open(canvas, [file_data('model'), file_data('model_b')],
    { is_dark: dark_wanted() });
  let shown = null;
  const errors_now = () => diff.errors.find((errors) => errors.clip === document.body.dataset.clip) ?? diff.errors[0];
  const paint_errors = () => {
    shown = errors_now();
    view.paint('error', error_values(diff, shown));
    return [scale_legend('0', error_text(shown.max)),
      make('p', { class: 'hint' }, shown.clip ? `Largest error of each vertex in ${shown.clip}, of the diagonal.`
        : 'Distance of each vertex in the bind pose, of the diagonal.'),
      make('ul', { class: 'swatches' }, swatch('#d0488f', 'no counterpart'))];
  };
  const paints = {
    materials: { label: 'Materials', hint: 'As the files have them', paint: () => view.paint('materials') },
    error: { label: 'Error', hint: 'Where they differ', paint: paint_errors },
    joints: { label: 'Joints', hint: 'The joint with the largest weight', paint: () => view.paint('joints') },
  };
  const { panel, colors, switches } = make_panel(view, paints);
  const player = new Player(view, rows);
  player.on_clip = () => { if (document.body.dataset.colors === 'error' && errors_now() !== shown) colors.choose('error'); };
  stage.firstChild.append(player.bar);
  stage.append(panel);
  colors.choose('error');
  return { view, player, colors, switches, paints };
}

function start_diff_page(page) {
  const diff = json_data('diff');
  let parts = null;
  const clips = diff_clips_section(diff, (clip, time) => show_clip(parts, clip, time));
  page.append(...[diff_overview(diff), make('div', { id: 'viewer_place' }), findings_section(diff), clips.element,
    drawings_section(diff, json_data('pictures')), counts_section(diff)].filter(Boolean));
  start_viewer((module) => open_diff_viewer(module, diff, clips.rows)).then((opened) => { parts = opened; });
}
