// What went in and came out, with digests.

function files_section(report) {
  const file_columns = [['File', (f) => f.name], ['Size', (f) => size_text(f.bytes), 'number'],
    ['SHA-256', (f) => make('code', null, f.sha256)]];
  const input_columns = [
    ['Input', (i) => i.name], ['File', (i) => i.file],
    ['Vertices', (i) => grouped(i.vertices), 'number'], ['Faces', (i) => grouped(i.faces), 'number'],
    ['Joints', (i) => grouped(i.joints), 'number'], ['Clips', (i) => grouped(i.clips), 'number'],
    ['Materials', (i) => grouped(i.materials), 'number'], ['Images', (i) => grouped(i.images), 'number'],
    ['Repairs', (i) => grouped(i.repairs.length), 'number'],
  ];
  const files = [...report.inputs.flatMap((input) => input.files), ...report.outputs];
  return section('files', 'Files', [table(input_columns, report.inputs), details('Digests', table(file_columns, files)),
    make('p', { class: 'hint' }, `skinforge ${report.tool.version}, recipe ${report.recipe.sha256.slice(0, 16)}…`)]);
}
