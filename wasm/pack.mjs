// Makes the script that a page loads: node pack.mjs GLUE.js MODULE.wasm OUT.js PACKAGE...
//
// A page that is opened from a disk may load scripts alone, so the module is a text in the script: base64 of gzip, as
// the motions of a case are. Prints the sizes.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';

// Code of the Debian packages is in the module. Their licences ask that their text goes along with every copy. The script
// may be read with any encoding guess, so it has ASCII alone.
function licences(packages) {
  const paths = packages.map((name) => `/usr/share/doc/${name}/copyright`).filter((path) => existsSync(path));
  const text = paths.map((path) => `${path}\n\n${readFileSync(path, 'utf8')}`).join('\n\n');
  return `/*!\n${text.replaceAll('*/', '* /').replace(/[^\n -~]/g, '?')}\n*/\n`;
}

const [glue, module, out, ...packages] = process.argv.slice(2);
if (!out) {
  console.error('usage: node pack.mjs GLUE.js MODULE.wasm OUT.js PACKAGE...');
  process.exit(2);
}
const bytes = readFileSync(module);
const text = gzipSync(bytes, { level: 9 }).toString('base64');
const script = `${readFileSync(glue, 'utf8')}\ncontortEngine.packed = '${text}';\n${licences(packages)}`;
writeFileSync(out, script);
console.log(`${out}: ${script.length} bytes, the module ${bytes.length} bytes`);
