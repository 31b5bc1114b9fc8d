// Runs the Khronos glTF validator on files and prints one line per finding.
//   node scripts/validate_gltf.mjs [--modules FOLDER] [--info] FILE...
// FOLDER holds the npm package gltf-validator (default: $NODE_PATH, then build/node/node_modules of this repository).
// Exit status: 0 no error and no warning, 1 some, 2 wrong usage or no validator. --info prints infos and hints too.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const SEVERITIES = ['error', 'warning', 'info', 'hint'];

function parseArguments(words) {
  const options = { folders: [], files: [], info: false };
  while (words.length > 0) {
    const word = words.shift();
    if (word === '--modules') options.folders.push(words.shift() ?? '');
    else if (word === '--info') options.info = true;
    else options.files.push(word);
  }
  return options;
}

function loadValidator(folders) {
  const repository = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
  const fallback = path.join(repository, 'build', 'node', 'node_modules');
  const places = [...folders, ...(process.env.NODE_PATH ?? '').split(path.delimiter).filter(Boolean), fallback];
  for (const place of places) {
    try {
      return createRequire(path.join(path.resolve(place), 'anchor.js'))(path.resolve(place, 'gltf-validator'));
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  console.error(`no package gltf-validator in ${places.join(', ')}: npm install gltf-validator`);
  process.exit(2);
}

async function validate(validator, file) {
  const folder = path.dirname(file);
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    maxIssues: 0,
    externalResourceFunction: (uri) =>
      readFile(path.join(folder, decodeURIComponent(uri))).then((bytes) => new Uint8Array(bytes)),
  });
  return report.issues.messages;
}

const options = parseArguments(process.argv.slice(2));
if (options.files.length === 0) {
  console.error('usage: node scripts/validate_gltf.mjs [--modules FOLDER] [--info] FILE...');
  process.exit(2);
}
const validator = loadValidator(options.folders);
let clean = true;
for (const file of options.files) {
  for (const finding of await validate(validator, file)) {
    if (finding.severity <= 1) clean = false;
    if (finding.severity > 1 && !options.info) continue;
    console.log(`${file}: ${SEVERITIES[finding.severity]} ${finding.code} ${finding.pointer ?? ''} ${finding.message}`);
  }
}
process.exit(clean ? 0 : 1);
