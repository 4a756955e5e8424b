// Browser tests of the report page.
//
//   node run.mjs --modules DIR --report DIR [--large DIR] [--strip DIR] [--single FILE] [--chromium PATH]
//   node run.mjs --modules DIR --contort BINARY --viewer DIR        makes the reports itself, see fixture.mjs
//
// --modules is the node_modules folder where `npm ci` was run with this folder's package.json.
// Some tests only: node --test-name-pattern=WORDS run.mjs …
// Tests for which a report has no case are skipped, and the output says so.
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { makeFixture } from './fixture.mjs';

const kPaths = ['modules', 'report', 'large', 'strip', 'single', 'contort', 'viewer'];
const usage = 'usage: node run.mjs --modules DIR (--report DIR [--large DIR] [--strip DIR] [--single FILE] | --contort BINARY --viewer DIR) ' +
  '[--chromium PATH]';

function readArguments(words) {
  const found = { chromium: '/usr/bin/chromium' };
  for (let i = 0; i < words.length; i += 2) {
    const name = words[i].replace(/^--/, '');
    if (![...kPaths, 'chromium'].includes(name) || i + 1 >= words.length) return null;
    found[name] = kPaths.includes(name) ? resolve(words[i + 1]) : words[i + 1];
  }
  return found.modules && (found.report || (found.contort && found.viewer)) ? found : null;
}

const options = readArguments(process.argv.slice(2));
if (!options) {
  console.error(usage);
  process.exit(2);
}
if (!existsSync(options.chromium)) {
  console.error(`run.mjs: no browser at ${options.chromium}: install chromium or give --chromium PATH`);
  process.exit(1);
}
if (!options.report) {
  const out = mkdtempSync(join(tmpdir(), 'page_fixture_'));
  process.on('exit', () => rmSync(out, { recursive: true, force: true }));
  makeFixture({ contort: options.contort, viewer: options.viewer, out });
  Object.assign(options, { report: join(out, 'report'), large: join(out, 'large'), single: join(out, 'single.html') });
}
process.env.CONTORT_PAGE_TEST = JSON.stringify(options);
await import('./all.mjs');
