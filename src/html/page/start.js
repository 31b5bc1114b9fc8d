// Puts the page together; the 3D view comes last, so that everything else is there without it.

function say_no_viewer(reason) {
  document.body.dataset.viewer = 'none';
  document.getElementById('viewer_place').replaceChildren(make('p', { class: 'note' }, reason));
}

// `open`: module -> parts of the view. Whatever goes wrong there stays there.
async function start_viewer(open) {
  try {
    const module = await viewer_module();
    if (!module) return say_no_viewer('No 3D view: this report was written by a program without its viewer ' +
      '(scripts/setup.sh --node, then build again).');
    const parts = await open(module);
    document.body.dataset.viewer = 'ready';
    follow_address(parts);
    return parts;
  } catch (error) {
    say_no_viewer(`The 3D view did not start in this browser: ${error.message}`);
    console.error(error);
  }
}

// Plays a clip, or with a time shows that moment of it.
function show_clip(parts, clip, time) {
  if (!parts) return;
  if (time === null) parts.player.start(clip);
  else parts.player.choose(clip, time);
  document.getElementById('viewer_place').scrollIntoView({ behavior: 'smooth', block: 'nearest' });
}

function start_build_page(page) {
  const data = { report: json_data('report'), timings: json_data('timings'), view: json_data('view') };
  let parts = null;
  const clips = clips_section(data.report, (clip, time) => show_clip(parts, clip, time));
  page.append(...[overview(data.report, data.timings), make('div', { id: 'viewer_place' }),
    golden_section(data.report), clips.element, junctions_section(data.report), pictures_section(json_data('pictures')),
    issues_section(data.report), ledger_section(data.report), timeline_section(data.timings),
    files_section(data.report)].filter(Boolean));
  start_viewer((module) => open_build_viewer(module, data, clips.rows)).then((opened) => { parts = opened; });
}

function start_page() {
  const page = document.getElementById('page');
  if (document.body.dataset.kind === 'diff') start_diff_page(page);
  else start_build_page(page);
}
