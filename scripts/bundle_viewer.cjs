// node bundle_viewer.cjs NODE_MODULES ENTRY OUTPUT: three.js and the viewer of reports as one compressed ES module.
const fs = require('fs');
const path = require('path');
const zlib = require('zlib');

const [modules, entry, output] = process.argv.slice(2);
const esbuild = require(path.join(modules, 'esbuild'));
const { outputFiles } = esbuild.buildSync({
  entryPoints: [entry],
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'inline',  // licences stay with the code
  nodePaths: [modules],
  write: false,
});
const packed = zlib.gzipSync(outputFiles[0].contents, { level: 9 });
packed[9] = 255;  // the system it was packed on: unknown, the same everywhere
fs.writeFileSync(output + '.new', packed);
fs.renameSync(output + '.new', output);
