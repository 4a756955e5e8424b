// For everyone: automatic checks in light and dark and on a phone, no sideways scrolling, keys alone.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { findCase, openCase, openPage, options, readCases, seriousProblems, urlOf } from './support.mjs';

const cases = readCases(options.report);
const any = findCase(cases, (data) => data.motions.length > 1) ?? findCase(cases, () => true);
const struck = findCase(cases, (data) => data.motions[0].marks.some(({ kind }) => kind === 'impact'));
const need = { skip: any === undefined ? 'the report has no motion' : false };

const looks = [['light', 1280], ['dark', 1280], ['light', 375], ['dark', 375]];
for (const [scheme, width] of looks) {
  test(`${scheme}, ${width} wide: the list has no serious problem`, async () => {
    const { page, close } = await openPage(await urlOf('file', options.report), { scheme, width, bypassCSP: true });
    assert.deepEqual(await seriousProblems(page), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
    await close();
  });

  test(`${scheme}, ${width} wide: an open case has no serious problem`, need, async () => {
    const url = await urlOf('file', options.report);
    const { page, close } = await openCase(url, any, { scheme, width, bypassCSP: true });
    assert.deepEqual(await seriousProblems(page), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
    await close();
  });
}

test('375 wide: names of blows stay in their track', { skip: struck === undefined ? 'the report has no blow' : false }, async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), struck, { width: 375 });
  const beyond = await page.locator('.tick-text').evaluateAll((texts) => texts.filter((text) => {
    const [one, track] = [text.closest('.tick'), text.closest('.track')].map((element) => element.getBoundingClientRect());
    return one.left < track.left - 1 || one.right > track.right + 1;
  }).map((text) => text.textContent));
  assert.deepEqual(beyond, []);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
  await close();
});

test('every control is reached with Tab and has a name', need, async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), any);
  const controls = '.case button:visible:not(:disabled), .case select:visible, .case input:visible';
  const wanted = await page.locator(controls).count();
  const reached = new Set();
  for (let i = 0; i < wanted + 10; ++i) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const element = document.activeElement;
      const all = [...document.querySelectorAll('.case button, .case select, .case input')];
      const name = element.getAttribute('aria-label') || element.textContent || element.closest('label')?.textContent;
      return { index: all.indexOf(element), name: name?.trim() };
    });
    if (at.index >= 0) { reached.add(at.index); assert.ok(at.name); }
  }
  assert.equal(reached.size, wanted);
  await close();
});

test('the spoken text is quiet while playing', need, async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), any, { frame: 0 });
  await page.waitForTimeout(400);
  await page.evaluate(() => {
    window.spoken = 0;
    new MutationObserver(() => { ++window.spoken; })
      .observe(document.querySelector('.controls [aria-live]'), { childList: true, characterData: true, subtree: true });
  });
  await page.selectOption('.speed', '0.5');
  await page.locator('.play').click();
  await page.waitForTimeout(500);
  assert.equal(await page.evaluate(() => window.spoken), 0);
  await page.locator('.play').click();
  await page.waitForFunction(() => window.spoken > 0);
  await close();
});
