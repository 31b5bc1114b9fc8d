// What was compared with what it must be like, in a comparison of two models and in a build with a golden.

function findings_table(findings) {
  const columns = [['', (f) => make('span', { class: `tag ${f.is_over ? 'bad' : 'good'}` }, f.is_over ? 'over' : 'same')],
    ['Group', (f) => f.group], ['What', (f) => f.name], ['Measured', (f) => f.text]];
  return table(columns, [...findings].sort((x, y) => Number(y.is_over) - Number(x.is_over)));
}

function golden_section(report) {
  if (!report.golden) return null;
  return section('golden', `Beside the golden ${report.golden.file}`, report.golden.missing
    ? make('p', null, 'There is none yet; skinforge build --accept makes it of this result.')
    : findings_table(report.golden.findings));
}
