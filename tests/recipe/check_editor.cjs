// node check_editor.cjs SCHEMA: asks a language service (npm vscode-json-languageservice, in $NODE_PATH) what an editor
// asks it, for every property of the schema: is the key offered where it may stand, and does hovering over it say what
// it is? Prints {"properties": N, "not_offered": [...], "not_explained": [...]}. Status 3 where the package is absent.
const fs = require('fs');

let service;
try {
  service = require('vscode-json-languageservice');
} catch (error) {
  process.exit(3);
}
const schema = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));
const uri = 'file:///recipe.schema.json';
const language = service.getLanguageService({ schemaRequestService: () => Promise.resolve(JSON.stringify(schema)) });
language.configure({ allowComments: true, schemas: [{ uri, fileMatch: ['*'], schema }] });

// Paths of properties: keys, and 0 for an item of a list.
function collect(part, path, found) {
  if (typeof part !== 'object' || part === null) return;
  if (part.properties && part.type)
    for (const [key, value] of Object.entries(part.properties)) {
      const below = [...path, key];
      const name = below.join('/');
      if (!found.has(name)) found.set(name, { path: below, description: value.description });
      collect(value, below, found);
    }
  if (part.items) collect(part.items, [...path, 0], found);
  if (typeof part.additionalProperties === 'object') collect(part.additionalProperties, [...path, 'any'], found);
  for (const alternative of [...(part.anyOf ?? []), ...(part.oneOf ?? [])]) collect(alternative, path, found);
}

// A document that leads to `path`, with `inside` there.
function around(path, inside) {
  return path.reduceRight((text, step) => (step === 0 ? `[${text}]` : `{${JSON.stringify(step)}: ${text}}`), inside);
}

async function main() {
  const found = new Map();
  collect(schema, [], found);
  const not_offered = [], not_explained = [];
  for (const { path, description } of found.values()) {
    const key = path[path.length - 1], above = path.slice(0, -1);
    const open = around(above, '{ "" }');
    const at = open.indexOf('{ "" }') + 3;
    const unfinished = service.TextDocument.create('file:///a.json', 'json', 1, open);
    const list = await language.doComplete(unfinished, unfinished.positionAt(at), language.parseJSONDocument(unfinished));
    if (!list.items.some((item) => item.label === key)) not_offered.push(path.join('/'));
    const whole = service.TextDocument.create('file:///b.json', 'json', 1, around(above, `{ ${JSON.stringify(key)}: 0 }`));
    const place = whole.positionAt(whole.getText().lastIndexOf(JSON.stringify(key)) + 1);
    const hover = await language.doHover(whole, place, language.parseJSONDocument(whole));
    const said = JSON.stringify(hover?.contents ?? '').replace(/[^A-Za-z]/g, '');
    if (!description || !said.includes(description.slice(0, 20).replace(/[^A-Za-z]/g, ''))) not_explained.push(path.join('/'));
  }
  console.log(JSON.stringify({ properties: found.size, not_offered, not_explained }));
}
main();
