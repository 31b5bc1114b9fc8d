// What was odd on the way.

const all_issues = (report) => [...report.inputs.flatMap((input) =>
  input.repairs.map((issue) => ({ ...issue, input: input.name }))), ...report.issues];

function issues_section(report) {
  const issues = all_issues(report).sort((a, b) => (a.severity === b.severity ? 0 : a.severity === 'warning' ? -1 : 1));
  const columns = [
    ['', (i) => make('span', { class: `tag ${i.severity === 'warning' ? 'warn' : 'quiet'}` }, i.severity)],
    ['Where', (i) => [i.input, i.place].filter(Boolean).join(': ')],
    ['What', (i) => i.message],
    ['Code', (i) => make('code', null, i.code)],
  ];
  return section('issues', 'Issues and repairs', issues.length ? table(columns, issues)
    : make('p', null, 'None: the inputs were sound, and nothing odd happened.'));
}
