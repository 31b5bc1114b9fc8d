// Elements are made of plain data, never of markup: what a file calls its joints stays text.

// make('td', {class: 'number', title: '...'}, 'text', element, ...); nothing is made of null and false.
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

// A section with a heading; none where there is nothing to say.
function section(id, heading, ...content) {
  const inside = content.flat().filter(Boolean);
  return inside.length ? make('section', { id }, make('h2', null, heading), ...inside) : null;
}

// columns: [heading, cell of a row, class]; a cell is text or an element.
function table(columns, rows, row_class) {
  const head = columns.map(([heading, , kind]) => make('th', { class: kind, scope: 'col' }, heading));
  const body = rows.map((row) => make('tr', { class: row_class ? row_class(row) : null },
    columns.map(([, cell, kind]) => make('td', { class: kind }, cell(row) ?? ''))));
  return make('div', { class: 'table' }, make('table', null, make('thead', null, make('tr', null, head)),
    make('tbody', null, body)));
}

function details(summary, ...content) {
  return make('details', null, make('summary', null, summary), ...content);
}
