// The 3D view of a build.

const dark_wanted = () => window.matchMedia('(prefers-color-scheme: dark)').matches;

function source_legend(view, sources) {
  return make('ul', { class: 'swatches' }, sources.map((name, i) => swatch(view.source_color(i), name)),
    swatch(view.new_color(), 'made new at a junction'));
}

function weight_chooser(view) {
  const names = view.joint_names();
  const list = make('select', { id: 'joint', size: 9, 'aria-label': 'Joint',
    onchange: () => view.paint('weight', Number(list.value)) });
  const fill = (text) => {
    const wanted = text.toLowerCase();
    list.replaceChildren(...names.map((name, j) => [name, j]).filter(([name]) => name.toLowerCase().includes(wanted))
      .map(([name, j]) => make('option', { value: j }, name)));
    if (list.options.length) list.selectedIndex = 0;
    if (list.value) view.paint('weight', Number(list.value));
  };
  const search = make('input', { type: 'search', placeholder: 'Find a joint', oninput: () => fill(search.value) });
  list.pick = (name) => {
    const joint = names.indexOf(name);
    if (joint < 0) return;
    list.value = String(joint);
    view.paint('weight', joint);
  };
  fill('');
  return { list, element: [search, list, scale_legend('0', 'weight 1')] };
}

function build_paints(view, data) {
  let chooser = null;
  const paints = {
    materials: { label: 'Materials', hint: 'As the file has them', paint: () => view.paint('materials') },
    source: { label: 'Source', hint: 'The input that each face comes from', paint: () => {
      view.paint('source', data.view);
      return source_legend(view, data.view.sources);
    } },
    joints: { label: 'Joints', hint: 'The joint with the largest weight', paint: () => view.paint('joints') },
    weight: { label: 'Weight', hint: 'The weight of one joint', paint: () => {
      chooser ??= weight_chooser(view);
      view.paint('weight', Number(chooser.list.value));
      paints.weight.pick = chooser.list.pick;
      return chooser.element;
    } },
  };
  return paints;
}

// Joint name -> number of its source.
const joint_sources = (report) => new Map(report.joints.map((j) => [j.joint, j.source]));

async function open_build_viewer(module, data, rows) {
  const canvas = make('canvas', { 'aria-label': 'The character in three dimensions' });
  const stage = make('div', { class: 'stage' }, make('div', { class: 'canvas' }, canvas));
  document.getElementById('viewer_place').replaceChildren(stage);
  const view = await module.ModelView.open(canvas, [file_data('model')],
    { is_dark: dark_wanted(), joint_source: joint_sources(data.report) });
  const paints = build_paints(view, data);
  const { panel, colors, switches } = make_panel(view, paints);
  const player = new Player(view, rows);
  stage.firstChild.append(player.bar);
  stage.append(panel);
  colors.choose('materials');
  return { view, player, colors, switches, paints };
}
