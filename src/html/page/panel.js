// What is drawn, and in which colours: the choices beside the 3D view.

// A row of buttons of which one is chosen.
function choice_of(id, choices, on_choice) {
  const buttons = choices.map(([value, label, hint]) => make('button', { value, title: hint, role: 'radio',
    onclick: () => group.choose(value) }, label));
  const group = make('div', { id, class: 'choices', role: 'radiogroup' }, buttons);
  group.choose = (value) => {
    for (const button of buttons) button.setAttribute('aria-checked', button.value === value);
    on_choice(value);
  };
  return group;
}

function switch_of(id, label, hint, on_change) {
  const box = make('input', { type: 'checkbox', id, onchange: () => on_change(box.checked) });
  const element = make('label', { class: 'switch', title: hint }, box, label);
  element.set = (on) => { box.checked = on; on_change(on); };
  return element;
}

const swatch = (color, text) => make('li', null, make('i', { style: `background:${color}` }), text);

const scale_legend = (from, to) => make('div', { class: 'scale' }, make('i'), make('span', null, from),
  make('span', null, to));

// `paints`: value -> {label, hint, paint(): draws and returns a legend}.
function make_panel(view, paints, extra) {
  const legend = make('div', { class: 'legend' });
  const colors = choice_of('colors', Object.entries(paints).map(([value, p]) => [value, p.label, p.hint]), (value) => {
    legend.replaceChildren(...[paints[value].paint()].flat().filter(Boolean));
    document.body.dataset.colors = value;
  });
  const switches = {
    wire: switch_of('wire', 'Wireframe', 'Edges of polygons, not of the triangles they are written as',
      (on) => view.set_wire(on)),
    skeleton: switch_of('skeleton', 'Skeleton', 'Joints in the colour of their source', (on) => view.set_skeleton(on)),
    floor: switch_of('floor', `Floor (lines every ${short_number(view.grid_spacing())} m)`, '', (on) => view.set_floor(on)),
  };
  switches.floor.firstChild.checked = true;
  const panel = make('aside', { class: 'panel' }, make('h3', null, 'Colours'), colors, legend, make('h3', null, 'Show'),
    Object.values(switches), extra, make('button', { class: 'plain', onclick: () => view.frame() }, 'Reset the camera'),
    make('p', { class: 'hint' }, 'Drag to turn, right drag to move, wheel to come near.'));
  return { panel, colors, switches };
}
