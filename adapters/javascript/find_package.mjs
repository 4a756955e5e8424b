// Finds the folder of an npm package, so that one adapter serves all versions of an engine.
import fs from 'node:fs';
import path from 'node:path';
import process from 'node:process';

// Returns { folder, version, module }, where `module` says whether its .js files are ES modules. It looks in the folder
// that the environment variable names, then in node_modules from the working directory upwards, then in NODE_PATH.
export function findPackage(name, variable) {
  for (const folder of candidates(name, process.env[variable])) {
    const file = path.join(folder, 'package.json');
    if (!fs.existsSync(file)) continue;
    const about = JSON.parse(fs.readFileSync(file, 'utf8'));
    if (about.name !== name) continue;
    return { folder: fs.realpathSync(folder), version: about.version, module: about.type === 'module' };
  }
  throw new Error(`cannot find the package ${name}: install it here with npm, or set ${variable} to its folder`);
}

function* candidates(name, chosen) {
  if (chosen) {
    yield path.resolve(chosen);
    yield path.resolve(chosen, 'node_modules', name);
    return;
  }
  for (let folder = process.cwd(); ; folder = path.dirname(folder)) {
    yield path.join(folder, 'node_modules', name);
    if (folder === path.dirname(folder)) break;
  }
  for (const folder of (process.env.NODE_PATH ?? '').split(path.delimiter)) {
    if (folder) yield path.join(folder, name);
  }
}
