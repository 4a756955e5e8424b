// Rules that the sources keep: no markup from strings, no evaluated code, files that can be read in one go.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { options } from './support.mjs';

const folder = resolve(dirname(fileURLToPath(import.meta.url)), '..', '..', 'renders', 'page');
const sources = [join(folder, 'page.js'), join(folder, 'rows.js'), ...['src', 'play', 'live'].flatMap((part) => readdirSync(join(folder, part))
  .filter((name) => name.endsWith('.js')).map((name) => join(folder, part, name)))];
// Reads the server's own page again.
const parses = join(folder, 'live', 'refresh.js');

test('no source builds markup from strings or evaluates text', () => {
  const forbidden = [/innerHTML|outerHTML|insertAdjacentHTML|document\.write/, /DOMParser|createContextualFragment/,
    /\beval\b|new Function/, /setAttribute\('(style|on)/];
  for (const file of sources)
    for (const pattern of forbidden)
      if (file !== parses || !pattern.test('DOMParser')) assert.doesNotMatch(readFileSync(file, 'utf8'), pattern, file);
});

test('no source is longer than 400 lines', () => {
  for (const file of sources) assert.ok(readFileSync(file, 'utf8').split('\n').length <= 401, file);
});

test('what is in the page itself can be put into a C++ string', () => {
  for (const [name, end] of [['page.js', ')js"'], ['rows.js', ')js"'], ['page.css', ')css"']]) {
    const text = readFileSync(join(folder, name), 'utf8');
    assert.ok(!text.includes(end), name);
    assert.ok(text.length < 60_000, name);
    assert.match(text, /^[\x00-\x7f]*$/, `${name} has only ASCII`);
    assert.ok(!/<\/(script|style)/i.test(text), name);
  }
});

test('the viewer names its parts\' licences', () => {
  const text = readFileSync(join(options.report, 'viewer', 'viewer.js'), 'utf8');
  for (const holder of [/Copyright .*three\.js authors/i, /Copyright .*Leon Sorokin/])
    assert.match(text.slice(-6000), holder);
  assert.ok(text.length < 1_000_000);
});
