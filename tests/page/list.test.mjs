// The list of failures: filter, search, keys, copying.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { openPage, options, urlOf } from './support.mjs';

const kSelects = [['check', 'data-check'], ['character', 'data-character'], ['part', 'data-parts'],
  ['phase', 'data-phase'], ['state', 'data-state']];
const visible = (page) => page.locator('.card:visible').count();
const total = (page) => page.locator('.card').count();

async function eachValue(page, id, attribute) {
  const values = await page.locator(`#${id} option`)
    .evaluateAll((all) => all.map((option) => option.value).filter(Boolean));
  for (const value of values) {
    await page.selectOption(`#${id}`, value);
    const cards = await page.locator('.card:visible')
      .evaluateAll((all, name) => all.map((card) => card.getAttribute(name)), attribute);
    assert.ok(cards.length > 0, `${id} ${value} shows some`);
    for (const card of cards) assert.ok(card.split(' ').includes(value), `${id} ${value}: ${card}`);
    assert.match(await page.locator('#shown').textContent(), new RegExp(`^${cards.length} of `));
  }
  await page.selectOption(`#${id}`, '');
  return values.length;
}

for (const way of ['file', 'http']) {
  test(`${way}: filters show what they name and stay in the address`, async () => {
    const { page, wrong, close } = await openPage(await urlOf(way, options.report));
    const all = await total(page);
    assert.equal(await visible(page), all);
    let some = 0;
    for (const [id, attribute] of kSelects)
      if (await page.locator(`#${id}:visible`).count()) some += await eachValue(page, id, attribute);
    assert.ok(some > 0);
    const check = await page.locator('.card').first().getAttribute('data-check');
    await page.fill('#words', `check:${check}`);
    const found = await visible(page);
    assert.ok(found >= 1 && found <= all);
    await page.reload();
    assert.equal(await visible(page), found, 'the address keeps the filter');
    await page.fill('#words', 'state:nosuchstate');
    assert.equal(await visible(page), 0);
    assert.ok(await page.locator('#no-match').isVisible());
    await page.fill('#words', 'constructor:x __proto__');
    assert.equal(await visible(page), 0);
    await page.focus('#words');
    await page.keyboard.press('Escape');
    assert.equal(await visible(page), all);
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: keys go through the list`, async () => {
    const { page, wrong, close } = await openPage(await urlOf(way, options.report));
    const focused = () => page.evaluate(() => [...document.querySelectorAll('.card')].indexOf(document.activeElement));
    await page.keyboard.press('j');
    assert.equal(await focused(), 0);
    await page.keyboard.press('j');
    assert.equal(await focused(), Math.min(1, await total(page) - 1));
    await page.keyboard.press('k');
    assert.equal(await focused(), 0);
    await page.keyboard.press('/');
    assert.equal(await page.evaluate(() => document.activeElement.id), 'words');
    await page.keyboard.type('j');
    assert.equal(await page.inputValue('#words'), 'j', 'letters in the field are letters');
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: the command is copied as it is`, async () => {
    const { page, close } = await openPage(await urlOf(way, options.report));
    if (way === 'http') await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
    const box = page.locator('.card .command:visible').first();
    await box.locator('.copy').click();
    await page.waitForFunction(() => document.querySelector('.card .command .copy').textContent === 'Copied');
    if (way === 'http')
      assert.equal(await page.evaluate(() => navigator.clipboard.readText()), await box.locator('code').textContent());
    await close();
  });

  test(`${way}: a place in the page is not taken for a filter`, async () => {
    const { page, close } = await openPage(await urlOf(way, options.report));
    await page.fill('#words', 'nothing has this');
    await page.evaluate(() => { location.hash = '#failures'; });
    await page.waitForTimeout(50);
    assert.equal(await page.inputValue('#words'), 'nothing has this');
    await close();
  });
}

const hasCauses = readFileSync(join(options.report, 'index.html'), 'utf8').includes("class='causes'");
const need = { skip: hasCauses ? false : 'the report has no causes' };

// The part of the film strip that an image with object-fit: none shows.
const shownPiece = (image) => image.evaluate((element) => {
  const { objectFit, objectPosition } = getComputedStyle(element);
  return `${objectFit} ${objectPosition}`;
});

test('causes stand above all cards, with the worst frame cut out of the strip', need, async () => {
  const { page, wrong, close } = await openPage(await urlOf('file', options.report));
  const place = (selector) => page.locator(selector).first().evaluate((element) => element.getBoundingClientRect());
  const [row, card] = [await place('table.causes tbody tr'), await place('.card')];
  assert.ok(row.top < card.top && row.top < 900, 'on the first screen');
  const thumb = page.locator('.thumb:has(img)').first();
  const box = await thumb.evaluate((element) => element.getBoundingClientRect());
  assert.ok(box.height > 40 && box.height <= 96, `a small picture: ${box.height}`);
  assert.match(await shownPiece(thumb.locator('img')), /^none -\d+px -\d+px$/);
  assert.match(await shownPiece(page.locator('.card .strip img').first()), /^fill/, 'a card shows the whole strip');
  assert.deepEqual(wrong, []);
  await close();
});

test('a cause unfolds and opens its worst case', need, async () => {
  const { page, wrong, close } = await openPage(await urlOf('file', options.report));
  assert.ok(!await page.locator('.members').first().isVisible());
  await page.locator('tr.unfold summary').first().click();
  assert.ok(await page.locator('.members').first().isVisible());
  assert.match(await page.locator('tr.unfold .command code').first().textContent(), /^contort replay /);
  await page.locator('.headline a').first().click();
  await page.waitForSelector('.case[data-ready]');
  await page.keyboard.press('Escape');
  assert.deepEqual(wrong, []);
  await close();
});

test('on a phone the worst frame comes first, and nothing scrolls sideways', need, async () => {
  const { page, close } = await openPage(await urlOf('file', options.report), { width: 390, height: 844 });
  await page.locator('tr.unfold summary').first().click();
  const top = (selector) => page.locator(selector).first().evaluate((element) => element.getBoundingClientRect().top);
  assert.ok(await top('.thumb') <= await top('.headline'));
  assert.ok(await top('.card .strip') < await top('.card .head'));
  assert.match(await shownPiece(page.locator('.card .strip[class*=tile-] img').first()), /^none -/, 'only the worst frame');
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
  const beyond = await page.evaluate(() => [...document.querySelectorAll('#causes *, .card .strip img')]
    .filter((element) => !element.closest('.thumb') && !element.closest('thead') &&
      element.getBoundingClientRect().right > innerWidth + 1).map((element) => element.outerHTML.slice(0, 80)));
  assert.deepEqual(beyond, []);
  await close();
});

test('causes are there without scripts, and lead to their cards', need, async () => {
  const { page, close } = await openPage(await urlOf('file', options.report), { javaScript: false });
  assert.ok(await page.locator('table.causes .thumb img').first().isVisible());
  await page.locator('tr.unfold summary').first().click();
  assert.ok(await page.locator('.members').first().isVisible());
  await close();
});
