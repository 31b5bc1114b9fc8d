// What became of each thing of each input: nothing is lost unseen.

const kStates = ['kept', 'changed', 'dropped'];

function ledger_section(report) {
  const kinds = [...new Set(report.ledger.map((entry) => entry.kind))];
  const of = (kind, state) => report.ledger.filter((e) => e.kind === kind && e.state === state);
  const sums = table([['', (kind) => kind], ...kStates.map((state) =>
    [state, (kind) => grouped(of(kind, state).length), 'number'])], kinds);
  const lists = ['dropped', 'changed', 'kept'].map((state) => {
    const entries = report.ledger.filter((entry) => entry.state === state);
    const columns = [['Input', (e) => e.input], ['', (e) => e.kind], ['Name', (e) => e.item],
      ['In the result', (e) => e.results.join(', ')], ['Why', (e) => e.reason]];
    return entries.length ? details(`${grouped(entries.length)} ${state}`, table(columns, entries)) : null;
  });
  return section('ledger', 'What became of the inputs', report.ledger.length ? [sums, lists].flat() : null);
}
