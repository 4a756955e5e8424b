// Module hooks for an old npm package whose ES modules leave out file endings and do not declare that they are modules.
// Register them with the address of the package's folder as data.
import fs from 'node:fs';
import { fileURLToPath } from 'node:url';

let folder = '';

export function initialize(data) {
  folder = data;
}

export async function resolve(specifier, context, next) {
  if (specifier.startsWith('.') && context.parentURL?.startsWith(folder)) {
    for (const ending of ['', '.js', '/index.js']) {
      const url = new URL(specifier + ending, context.parentURL);
      if (fs.statSync(url, { throwIfNoEntry: false })?.isFile()) return { url: url.href, shortCircuit: true };
    }
  }
  return next(specifier, context);
}

export async function load(url, context, next) {
  if (!url.startsWith(folder)) return next(url, context);
  return { format: 'module', source: fs.readFileSync(fileURLToPath(url)), shortCircuit: true };
}
