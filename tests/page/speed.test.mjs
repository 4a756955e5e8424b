// A page of three thousand failures, and the size of what is loaded before any case is opened.
import assert from 'node:assert/strict';
import { statSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { openPage, options, urlOf } from './support.mjs';

const skip = options.large ? false : 'no --large DIR';

test('the page before media is at most 1 MB', (t) => {
  const bytes = statSync(join(options.report, 'index.html')).size;
  t.diagnostic(`index.html: ${bytes} bytes`);
  if (bytes > 1_048_576) assert.fail(`${bytes} bytes`);
});

for (const way of ['file', 'http']) {
  test(`${way}: a large page is ready in less than 2 s`, { skip }, async (t) => {
    const { page, wrong, close } = await openPage(await urlOf(way, options.large));
    const times = await page.evaluate(() => {
      const [entry] = performance.getEntriesByType('navigation');
      return { interactive: entry.domInteractive, complete: entry.domComplete || entry.domInteractive };
    });
    const whole = await page.evaluate(async () => { await window.contortPage.whole; return performance.now(); });
    const filtering = await page.evaluate(() => {
      const words = document.getElementById('words');
      const start = performance.now();
      words.value = 'state:new';
      words.dispatchEvent(new Event('input'));
      document.body.getBoundingClientRect();
      return performance.now() - start;
    });
    const cards = await page.locator('.card').count();
    t.diagnostic(`${cards} cards, interactive after ${Math.round(times.interactive)} ms, ` +
      `complete after ${Math.round(times.complete)} ms, whole after ${Math.round(whole)} ms, one filter ${Math.round(filtering)} ms, ` +
      `page ${statSync(join(options.large, 'index.html')).size} bytes`);
    assert.ok(statSync(join(options.large, 'index.html')).size < 1_048_576);
    assert.ok(times.interactive < 2000);
    assert.ok(whole < 4000, 'also those that come later');
    assert.ok(filtering < 300);
    assert.deepEqual(wrong, []);
    await close();
  });
}
