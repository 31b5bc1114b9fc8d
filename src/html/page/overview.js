// Name and numbers at the top.

function fact(value, name, hint) {
  return make('div', { class: 'fact', title: hint }, make('b', null, value), make('span', null, name));
}

function operation_text(operation) {
  const at = operation.at.join(' and ');
  const part = `${operation.joint} of ${operation.input}`;
  if (operation.kind === 'replace') return `${at} replaced by ${part}`;
  if (operation.kind === 'attach') return `${part} added at ${at}`;
  return operation.kind === 'remove' ? `${at} removed` : `only ${at} kept`;
}

function verdict_of(report) {
  const warnings = all_issues(report).filter((issue) => issue.severity === 'warning').length;
  const dropped = report.ledger.filter((entry) => entry.state === 'dropped').length;
  return make('p', { class: 'verdict' },
    make('span', { class: warnings ? 'tag warn' : 'tag good' }, count_text(warnings, 'warning')),
    make('span', { class: 'tag' }, dropped ? `${count_text(dropped, 'thing')} of the inputs dropped` : 'nothing lost'),
    report.operations.map((operation) => make('span', { class: 'tag quiet' }, operation_text(operation))));
}

function overview(report, timings) {
  const mesh = report.mesh, size = mesh.bind_size;
  const triangles = mesh.triangles + 2 * mesh.quads;
  return make('header', null, make('h1', null, report.recipe.name), verdict_of(report), make('div', { class: 'facts' },
    fact(grouped(mesh.vertices), 'vertices'),
    fact(grouped(mesh.faces), 'faces', `${grouped(mesh.quads)} of them quads`),
    fact(percent_text(mesh.faces ? mesh.quads / mesh.faces : 0, 0), 'quads'),
    fact(grouped(triangles), 'triangles', 'polygons of five corners and more not counted'),
    fact(grouped(report.joints.length), 'joints'),
    fact(grouped(report.clips.length), 'clips'),
    fact(String(report.weights.max_influences), 'influences', 'joints that a vertex follows at most'),
    fact(`${short_number(size[1])} m`, 'tall', `${size.map(short_number).join(' × ')} m in the bind pose`),
    fact(percent_text(mesh.kept_share), 'kept', 'faces that are those of an input, unchanged'),
    report.outputs.filter((o) => o.name.endsWith('.glb')).map((o) => fact(size_text(o.bytes), 'GLB', o.name)),
    timings && fact(seconds_text(timings.cpu), 'of work', 'processor time of all stages, those from the cache as when they ran')));
}
