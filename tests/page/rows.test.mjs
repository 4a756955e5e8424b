// Failures for which the page has no room: they come from files beside it, and are like the others then.
import assert from 'node:assert/strict';
import { rmSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { copyOf, openPage, options, ready, urlOf } from './support.mjs';

const skip = options.large ? false : 'no --large DIR';
const whole = (page) => page.evaluate(() => window.contortPage.whole);
const told = (page) => page.locator('#shown').textContent();

for (const way of ['file', 'http']) {
  test(`${way}: all rows are in the list, in the filters and in the words that are searched`, { skip }, async () => {
    const { page, wrong, close } = await openPage(await urlOf(way, options.large));
    await whole(page);
    assert.equal(await page.locator('.card').count(), 3000);
    assert.equal(await told(page), '3000 of 3000 kinds of failure shown');
    assert.equal(await page.locator('.rest').count(), 0, 'nothing is elsewhere any more');
    await page.fill('#words', 'joint_2999');
    assert.equal(await told(page), '1 of 3000 kinds of failure shown');
    await page.fill('#words', '');
    assert.equal(await page.locator('.card').first().locator('details .bucket').count(), 1, 'a card goes on');
    await page.selectOption('#phase', 'mid_clip');
    const phases = await page.locator('.card:visible').evaluateAll((all) => all.map((card) => card.dataset.phase));
    assert.ok(phases.length > 400 && phases.every((phase) => phase === 'mid_clip'));
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: a link to a late case opens it, and back goes to its card`, { skip }, async () => {
    const key = `balance-${(2999 * 2654435761 >>> 0).toString(16).padStart(8, '0')}`;
    const { page, wrong, close } = await openPage(`${await urlOf(way, options.large)}#case=${key}`);
    await ready(page);
    await page.keyboard.press('Escape');
    await page.waitForFunction((wanted) =>
      document.activeElement.closest('.bucket')?.dataset.case === wanted, key);
    assert.deepEqual(wrong, []);
    await close();
  });
}

test('without the files the page says so and names the plain list', { skip }, async () => {
  const copy = copyOf(options.large);
  rmSync(join(copy, 'rows', 'part-3.js'));
  const { page, close } = await openPage(await urlOf('file', copy));
  await whole(page);
  assert.match(await page.locator('#rest').textContent(), /missing or damaged.*more failures in the plain list/s);
  assert.equal(await page.locator('#rest a').getAttribute('href'), 'more.html');
  assert.ok(await page.locator('.card').count() > 1000, 'those that are there are shown');
  await close();
});

test('without scripts the page says where the others are', { skip }, async () => {
  const { page, close } = await openPage(await urlOf('file', options.large), { javaScript: false });
  assert.match(await page.locator('#rest').innerText(), /2601 more failures in the plain list/);
  await page.locator('#rest a').click();
  assert.match(page.url(), /more\.html$/);
  await close();
});
