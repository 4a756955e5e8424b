// Tests of what can go wrong: hostile names, missing and damaged files, no WebGL, no scripts.
import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { test } from 'node:test';
import {
  browser, copyOf, findCase, openCase, openPage, options, picture, placeOf, readCases, ready, shownFrame, urlOf,
} from './support.mjs';

const cases = readCases(options.report);
const any = findCase(cases, () => true);
const hostile = findCase(cases, (data) => /[<>]/.test(data.subject));
const need = (key, what) => ({ skip: key === undefined ? `the report has no case with ${what}` : false });
const caseFile = (folder, key) => join(folder, 'cases', `${key}.js`);
const callOf = (key, data) => `contortCase(${JSON.stringify(key)}, ${data});`;

// Console errors about a file that is missing or damaged are the browser's own and belong to it.
const kOwn = /Failed to load resource|SyntaxError|Unexpected|Invalid or unexpected/;
const unexpected = (wrong) => wrong.filter((text) => !kOwn.test(text));

for (const way of ['file', 'http']) {
  test(`${way}: hostile names stay text`, need(hostile, 'a hostile name'), async () => {
    const { page, wrong, close } = await openCase(await urlOf(way, options.report), hostile);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.equal(await page.locator('.case script, .case iframe, .case img[src="x"]').count(), 0);
    assert.match(await page.locator('.case-title').textContent(), /<script>window\.hacked=1<\/script>/);
    assert.equal(await page.locator('.case [style*="expression"], .case [onerror], .case [onclick]').count(), 0);
    const text = await page.locator('.case').evaluate((element) => element.textContent);
    assert.doesNotMatch(text, /[\u202a-\u202e\u2066-\u2069]/, 'nothing turns the order of the text around');
    assert.deepEqual(wrong, []);
    await close();
  });

  const damages = {
    missing: (folder) => rmSync(caseFile(folder, any)),
    'cut short': (folder) =>
      writeFileSync(caseFile(folder, any), readFileSync(caseFile(folder, any), 'utf8').slice(0, 3000)),
    empty: (folder) => writeFileSync(caseFile(folder, any), ''),
    'of another case': (folder) => writeFileSync(caseFile(folder, any), "contortCase('other-1', {});"),
    'without motions': (folder) => writeFileSync(caseFile(folder, any),
      callOf(any, "{format: 'contort.report_case/1', motions: []}")),
    'of another format': (folder) => writeFileSync(caseFile(folder, any), callOf(any, "{format: 'x/9'}")),
    'not an object': (folder) => writeFileSync(caseFile(folder, any), callOf(any, '7')),
  };
  for (const [name, damage] of Object.entries(damages)) {
    test(`${way}: a case file that is ${name} gives a sentence`, need(any, 'a motion'), async () => {
      const folder = copyOf(options.report);
      damage(folder);
      const { page, wrong, close } = await openPage(await urlOf(way, folder));
      await page.locator(`.bucket[data-case="${any}"] .open`).click();
      const sentence = page.locator(`.bucket[data-case="${any}"] .problem`);
      await sentence.waitFor();
      assert.match(await sentence.textContent(), /^(The file|Case) .*(missing|damaged|cannot be shown).*\.$/);
      assert.ok(await page.locator('.card:visible').count() > 0);
      assert.deepEqual(unexpected(wrong), []);
      await close();
    });
  }

  test(`${way}: a damaged model leaves the numbers`, need(any, 'a motion'), async () => {
    const folder = copyOf(options.report);
    const data = structuredClone(JSON.parse(JSON.stringify(cases.get(any))));
    data.motions[0].glb = `${data.motions[0].glb.slice(0, 500)}AAAA`;
    writeFileSync(caseFile(folder, any), callOf(any, JSON.stringify(data)));
    const { page, wrong, close } = await openCase(await urlOf(way, folder), any);
    assert.match(await page.locator('.stage-sentence').textContent(), /damaged/);
    await page.locator('.scrub').fill('3');
    assert.equal(await shownFrame(page), 3);
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: a missing viewer and an unknown case give a sentence`, need(any, 'a motion'), async () => {
    const folder = copyOf(options.report);
    rmSync(join(folder, 'viewer', 'viewer.js'));
    const { page, wrong, close } = await openPage(await urlOf(way, folder));
    await page.locator(`.bucket[data-case="${any}"] .open`).click();
    await page.locator('.problem').waitFor();
    assert.match(await page.locator('.problem').textContent(), /viewer cannot be loaded/);
    await page.evaluate(() => { location.hash = '#case=nosuch-<b>1</b>'; });
    await page.waitForFunction(() => [...document.querySelectorAll('.problem')]
      .some((note) => note.textContent.includes('no case nosuch-<b>1</b>')));
    assert.deepEqual(unexpected(wrong), []);
    await close();
  });

  test(`${way}: without WebGL the motion plays flat`, need(any, 'a motion'), async () => {
    const { page, wrong, close } = await openCase(await urlOf(way, options.report), any, { gl: false, frame: 0 });
    const context = await page.evaluate(() => document.createElement('canvas').getContext('webgl2'));
    assert.equal(context, null, 'really without');
    assert.match(await page.locator('.stage-sentence').textContent(), /WebGL/);
    const first = await picture(page);
    await page.keyboard.press(' ');
    await page.waitForFunction(() => Number(document.querySelector('.scrub').value) >= 5);
    await page.keyboard.press(' ');
    await page.keyboard.press('w');
    assert.ok(!first.equals(await picture(page)));
    if (await page.locator('.curve-plot .u-over').count()) {
      const { x, y } = await placeOf(page, '.curve-plot .u-over', 4);
      await page.mouse.click(x, y);
      assert.ok(Math.abs(await shownFrame(page) - 4) <= 1);
      assert.ok(await page.locator('.heat-canvas').isVisible());
    }
    assert.ok(await page.locator('.spec').isVisible());
    assert.deepEqual(wrong, []);
    await close();
  });
}

test('without scripts the page is complete and has no dead buttons', async () => {
  const context = await (await browser()).newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(await urlOf('file', options.report));
  assert.ok(await page.locator('.card:visible').count() > 0);
  for (const dead of ['.open', '.copy', '.filter'])
    assert.equal(await page.locator(`${dead}:visible`).count(), 0, dead);
  await context.close();
});

test('one file holds everything', { skip: options.single ? false : 'no --single FILE' }, async () => {
  const { page, wrong, close } = await openPage(await urlOf('file', dirname(options.single), basename(options.single)));
  const inside = await page.locator('script[type="application/json"]')
    .evaluateAll((elements) => elements.map((element) => element.id.replace(/^case-/, '')));
  const shown = await page.locator('.bucket:visible').evaluateAll((all) => all.map((bucket) => bucket.dataset.case));
  const key = shown.find((one) => inside.includes(one));
  await page.locator(`.bucket[data-case="${key}"] .open`).click();
  await ready(page);
  assert.ok(await page.locator('.stage-canvas').isVisible());
  // Pictures may be missing next to a file of a fixture; nothing else may be asked for.
  assert.deepEqual(unexpected(wrong), []);
  await close();
});
