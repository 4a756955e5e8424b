// An open case: picture, scrub bar, curves, heat map, spec, ways in and out.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { intervals, number } from '../../renders/page/src/format.js';
import { violatedRuns } from '../../renders/page/src/intervals.js';
import {
  copyOf, findCase, headFrame, openCase, openPage, options, picture, placeOf, readCases, ready, settle, shownFrame,
  urlOf,
} from './support.mjs';

const cases = readCases(options.report);
const any = findCase(cases, () => true);
// Nothing but the character moves here, and it had time to get away from where it began. It may be back at the end.
const moving = findCase(cases, ({ motions: [motion] }) =>
  motion.marks.length + motion.balance.length === 0 && motion.ghost_glb === '' &&
  motion.worst_frame >= 5 && motion.worst_frame < motion.frame_count - 1 &&
  !/[<>]/.test(motion.curves[0]?.subject));
const withOriginal = findCase(cases, (data) => data.motions.some((motion) => motion.role === 'original'));
const withGhost = findCase(cases, (data) => data.motions[0].ghost_glb !== '');
const withColliders = findCase(cases, (data) => data.motions[0].colliders.length > 0);
const withCurves = findCase(cases, (data) => data.motions[0].curves.length > 2);
const firstBlow = ({ motions: [motion] }) =>
  motion.marks.filter((mark) => mark.impulse).sort((one, other) => one.frame - other.frame)[0];
const withBlow = findCase(cases, (data) => firstBlow(data)?.frame > 0);
const withFree = findCase(cases, (data) => data.motions[0].free_fields.length > 0);
const need = (key, what) => ({ skip: key === undefined ? `the report has no case with ${what}` : false });
const wantedFrame = (key) => cases.get(key).motions[0].worst_frame;
const lastFrame = (key) => cases.get(key).motions[0].frame_count - 1;

// tests/renders/wording_test.cpp has the same table for the page and the console.
test('one number is written in one way', () => {
  const wanted = [[0, '0'], [-0, '0'], [0.001, '0.001'], [0.00012, '1.2e-4'], [-0.02345, '-0.0234'], [1.5, '1.5'],
    [12.04, '12'], [-999.6, '-1\u202f000'], [-2002, '-2\u202f000'], [-2e3, '-2\u202f000'], [3600.4, '3\u202f600'],
    [999499, '999\u202f000'], [999999, '1e6'], [-1.5e9, '-1.5e9'], [0.0009999, '0.001']];
  for (const [value, text] of wanted) assert.equal(number(value), text);
});

test('every interval of a violation is found', () => {
  const runs = violatedRuns({ margins: [1, -1, -2, null, -1, 0, -1e-9, -3], resolution: 1e-6 });
  assert.deepEqual(runs, [{ first: 1, last: 2 }, { first: 4, last: 4 }, { first: 7, last: 7 }]);
  assert.equal(intervals(runs), '3 times: frames 1\u20132, 4 and 7');
  assert.equal(intervals(runs.slice(1, 2)), 'frame 4');
  assert.equal(intervals([]), '');
});

const named = findCase(cases, (data) => data.title && data.character);
const withUnmet = findCase(cases, (data) => data.motions[0].unmet?.length > 0);
const notJudged = findCase(cases, (data) => data.motions[0].not_judged?.length > 0);
const measured = findCase(cases, (data) => data.motions[0].measured);

test('the heading names the character and the check in plain words', need(named, 'a title'), async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), named);
  const text = await page.locator('.case-title').textContent();
  assert.ok(text.includes(cases.get(named).title) && text.endsWith(`on ${cases.get(named).character}`), text);
  await close();
});

test('value and limit stand in the place of a margin', need(measured, 'a measured value'), async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), measured);
  const text = await page.locator('.case-facts').textContent();
  assert.ok(text.includes(cases.get(measured).motions[0].measured));
  assert.ok(!text.includes('worst margin'));
  await close();
});

test('every interval is marked above the scrub bar', need(withCurves, 'curves'), async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), withCurves);
  const [curve] = cases.get(withCurves).motions[0].curves;
  const runs = violatedRuns({ resolution: 0, ...curve });
  assert.equal(await page.locator('.violation').count(), runs.length);
  assert.ok((await page.locator('.case-facts').textContent()).includes(intervals(runs)));
  await close();
});

test('requests that were not met have a section', need(withUnmet, 'an unmet request'), async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), withUnmet);
  const { motions: [{ unmet: [one] }] } = cases.get(withUnmet);
  assert.match(await page.locator('.unmet li').first().textContent(), new RegExp(`${one.action}.*${one.why}`));
  await close();
});

test('what was not judged has a section', need(notJudged, 'a check that could not judge'), async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), notJudged);
  const { motions: [{ not_judged: all }] } = cases.get(notJudged);
  assert.equal(await page.locator('.not-judged li').count(), all.length);
  assert.ok((await page.locator('.not-judged').textContent()).includes(all[0].reason));
  await close();
});

test('the picture has a legend for the ghost and for arrows', need(withGhost, 'a ghost'), async () => {
  const { page, close } = await openCase(await urlOf('file', options.report), withGhost);
  const text = await page.locator('.stage-legend').textContent();
  assert.match(text, /ghost/);
  if (firstBlow(cases.get(withGhost))) assert.match(text, /arrow: a blow/);
  await close();
});

for (const way of ['file', 'http']) {
  const start = () => urlOf(way, options.report);

  test(`${way}: the button opens a case, Close and Escape go back to it`, need(any, 'a motion'), async () => {
    const { page, wrong, close } = await openPage(await start());
    const button = page.locator(`.bucket[data-case="${any}"] .open`);
    await button.scrollIntoViewIfNeeded();
    await button.click();
    await ready(page);
    assert.ok(!await page.locator('.card').first().isVisible(), 'the list is away');
    assert.equal(await shownFrame(page), wantedFrame(any), 'starts at the worst frame');
    await page.waitForFunction((key) => location.hash.includes(`case=${encodeURIComponent(key)}`), any);
    const back = async () => {
      assert.ok(await page.locator('.card:visible').count() > 0);
      assert.equal(await page.evaluate(() => document.activeElement.closest('[data-case]')?.dataset.case), any);
      assert.ok(!(await page.evaluate(() => location.hash)).includes('case='));
      assert.ok(await button.evaluate((element) => {
        const box = element.getBoundingClientRect();
        return box.top >= 0 && box.bottom <= innerHeight;
      }), 'the card is in sight');
    };
    await page.locator('.case .close').click();
    await back();
    await page.keyboard.press('Enter');
    await ready(page);
    await page.keyboard.press('Escape');
    await back();
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: Enter on a card opens it, j and k go on and back`, need(any, 'a motion'), async () => {
    const { page, wrong, close } = await openPage(await start());
    await page.keyboard.press('j');
    const keys = await page.locator('.bucket[data-case]')
      .evaluateAll((all) => all.map((bucket) => bucket.dataset.case));
    await page.keyboard.press('Enter');
    await ready(page);
    const at = () => page.evaluate(() => new URLSearchParams(location.hash.slice(1)).get('case'));
    const reached = (key) => page.waitForFunction((wanted) =>
      new URLSearchParams(location.hash.slice(1)).get('case') === wanted, key);
    await reached(keys[0]);
    if (keys.length > 1) {
      await page.keyboard.press('j');
      await reached(keys[1]);
      await page.keyboard.press('k');
      await reached(keys[0]);
    }
    await page.keyboard.press('k');
    await settle(page);
    assert.equal(await at(), keys[0], 'nothing before the first');
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: an address opens the case at its frame`, need(any, 'a motion'), async () => {
    const { page, wrong, close } = await openCase(await start(), any, { frame: 3 });
    assert.equal(await shownFrame(page), 3);
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => location.hash.includes('frame=4'));
    const link = await page.evaluate(() => location.href);
    await close();
    const again = await openPage(link);
    await ready(again.page);
    assert.equal(await shownFrame(again.page), 4, 'a copied link shows the same frame');
    await again.page.evaluate(() => { location.hash = location.hash.replace('frame=4', 'frame=7'); });
    await again.page.waitForFunction(() => document.querySelector('.scrub').value === '7');
    assert.deepEqual([...wrong, ...again.wrong], []);
    await again.close();
  });

  test(`${way}: playing moves the picture, scrubbing and keys set the frame`, need(moving, 'a motion'), async () => {
    const { page, wrong, close } = await openCase(await start(), moving, { frame: 0 });
    const first = await picture(page);
    assert.ok(first.equals(await picture(page)), 'a paused picture stands still');
    // Play slowly, so that a motion of a quarter of a second does not end before a busy machine has looked.
    await page.selectOption('.speed', '0.1');
    await page.locator('.case-title').focus();
    await page.keyboard.press(' ');
    await page.waitForFunction(() => Number(document.querySelector('.scrub').value) >= 5);
    assert.equal(await page.locator('.play').textContent(), 'Pause');
    await page.keyboard.press(' ');
    const stopped = await shownFrame(page);
    await page.waitForTimeout(120);
    assert.equal(await shownFrame(page), stopped);
    const last = cases.get(moving).motions[0].frame_count - 1;
    await page.locator('.scrub').fill(String(last));
    assert.equal(await shownFrame(page), last);
    await page.locator('.scrub').fill(String(wantedFrame(moving)));
    assert.ok(!first.equals(await picture(page)), 'another frame is another picture');
    await page.locator('.case-title').focus();
    await page.keyboard.press('Home');
    assert.ok(first.equals(await picture(page)), 'the same frame is the same picture');
    await page.keyboard.press('Shift+ArrowRight');
    assert.equal(await shownFrame(page), 10);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await shownFrame(page), 9);
    await page.keyboard.press('w');
    assert.equal(await shownFrame(page), wantedFrame(moving));
    await page.locator('[aria-label="One frame on"]').click();
    assert.equal(await shownFrame(page), Math.min(last, wantedFrame(moving) + 1));
    await page.locator('button.worst').click();
    assert.equal(await shownFrame(page), wantedFrame(moving));
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: speed and loop`, need(any, 'a motion'), async () => {
    const { page, close } = await openCase(await start(), any, { frame: 0 });
    const { frame_count: count, rate_hz: rate } = cases.get(any).motions[0];
    await page.selectOption('.speed', '0.1');
    const began = Date.now();
    await page.locator('.play').click();
    await page.waitForTimeout(500);
    const slow = await shownFrame(page);
    const seconds = (Date.now() - began) / 1000;
    assert.ok(slow >= 1 && slow <= 0.1 * rate * seconds + 2, `a tenth of the speed: ${slow} frames in ${seconds} s`);
    await page.locator('.play').click();
    await page.selectOption('.speed', '2');
    await page.locator('.scrub').fill(String(count - 3));
    await page.locator('.play').click();
    await page.waitForFunction((last) => document.querySelector('.scrub').value === last, String(count - 1));
    await page.waitForFunction(() => document.querySelector('.play').textContent === 'Play');
    await page.keyboard.press('l');
    await page.locator('.scrub').fill(String(count - 3));
    await page.locator('.play').click();
    await page.waitForFunction((last) => Number(document.querySelector('.scrub').value) < last, count - 3);
    assert.equal(await page.locator('.play').textContent(), 'Pause', 'goes on from the start');
    await close();
  });

  test(`${way}: the play head follows, curves and heat map seek`, need(withCurves, 'curves'), async () => {
    const { page, wrong, close } = await openCase(await start(), withCurves);
    const count = cases.get(withCurves).motions[0].frame_count;
    for (const frame of [0, Math.floor(count / 3), count - 1]) {
      await page.locator('.scrub').fill(String(frame));
      assert.ok(Math.abs(await headFrame(page) - frame) < 0.6 + count / 500, `play head at ${frame}`);
    }
    const thumbAndHead = await page.evaluate(() => {
      const bar = document.querySelector('.scrub').getBoundingClientRect();
      const head = document.querySelector('.playhead').getBoundingClientRect();
      return bar.right - 9 - (head.left + head.width / 2);  // The handle is 18 wide, and at its right end.
    });
    assert.ok(Math.abs(thumbAndHead) < 2, `handle over the head: ${thumbAndHead}`);
    for (const [selector, share] of [['.curve-plot .u-over', 0.3], ['.heat-canvas', 0.4]]) {
      for (const part of [0.2, 0.7]) {
        const frame = Math.floor(count * part);
        const { x, y } = await placeOf(page, selector, frame, share);
        await page.mouse.click(x, y);
        assert.ok(Math.abs(await shownFrame(page) - frame) <= 1, `${selector} at ${frame}`);
      }
      const from = await placeOf(page, selector, 2, share);
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      const to = await placeOf(page, selector, count - 3, share);
      await page.mouse.move(to.x, to.y, { steps: 4 });
      await page.mouse.up();
      assert.ok(Math.abs(await shownFrame(page) - (count - 3)) <= 1, `${selector} drags`);
    }
    await page.keyboard.press('Home');
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: heat map tells rows with keys, other curves can be added`, need(withCurves, 'curves'), async () => {
    const { page, wrong, close } = await openCase(await start(), withCurves);
    const { curves } = cases.get(withCurves).motions[0];
    await page.locator('.heat-canvas').focus();
    await page.keyboard.press('ArrowDown');
    assert.match(await page.locator('.readout').textContent(),
      new RegExp(`^${curves[1].check} .*frame ${wantedFrame(withCurves)}, `));
    await page.keyboard.press('ArrowRight');
    assert.match(await page.locator('.readout').textContent(), new RegExp(`frame ${Math.min(wantedFrame(withCurves) + 1, lastFrame(withCurves))}, `));
    assert.equal(await page.locator('.curve-figure').count(), 1);
    await page.locator('.others input').first().check();
    assert.equal(await page.locator('.curve-figure').count(), 2);
    await page.locator('.others input').first().uncheck();
    assert.equal(await page.locator('.curve-figure').count(), 1);
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: ghost`, need(withGhost, 'a ghost'), async () => {
    const { page, wrong, close } = await openCase(await start(), withGhost);
    const before = await picture(page);
    await page.getByRole('button', { name: 'Ghost' }).click();
    assert.ok(!before.equals(await picture(page)));
    await page.keyboard.press('g');
    assert.ok(before.equals(await picture(page)));
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: colliders and x-ray`, need(withColliders, 'colliders'), async () => {
    const { page, wrong, close } = await openCase(await start(), withColliders);
    const before = await picture(page);
    await page.getByRole('button', { name: 'Colliders' }).click();
    assert.ok(!before.equals(await picture(page)));
    await page.keyboard.press('c');
    assert.ok(before.equals(await picture(page)));
    const { highlight } = cases.get(withColliders).motions[0];
    if (highlight.joints.length + highlight.colliders.length > 0) {
      await page.keyboard.press('x');
      assert.equal(await page.getByRole('button', { name: 'X-ray' }).getAttribute('aria-pressed'), 'false');
    }
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: blows have an arrow for a while`, need(withBlow, 'a blow'), async () => {
    const { page, wrong, close } = await openCase(await start(), withBlow);
    const { balance } = cases.get(withBlow).motions[0];
    const { frame } = firstBlow(cases.get(withBlow));
    const has = async (at, colour) => {
      await page.locator('.scrub').fill(String(at));
      return countColour(page, await picture(page), colour);
    };
    const arrow = [163, 23, 143];
    assert.equal(await has(frame - 1, arrow), 0);
    assert.ok(await has(frame, arrow) > 20);
    assert.ok(balance.length === 0 || /zero moment point/.test(await page.locator('.pane-0').textContent()));
    assert.deepEqual(wrong, []);
    await close();
  });

  test(`${way}: side by side plays in step`, need(withOriginal, 'an original'), async () => {
    const { page, wrong, close } = await openCase(await start(), withOriginal);
    const [minimal] = cases.get(withOriginal).motions;
    const original = cases.get(withOriginal).motions.find((motion) => motion.role === 'original');
    await page.locator('[data-motion=both]').click();
    await ready(page, 'both');
    const frames = () => page.locator('.pane-label').evaluateAll((all) =>
      all.map((label) => Number(/frame (\d+)/.exec(label.textContent)?.[1])));
    const lined = minimal.worst_frame >= 0 && original.worst_frame >= 0;
    const expected = (frame) => {
      const time = (frame - (lined ? minimal.worst_frame : 0)) / minimal.rate_hz;
      const other = Math.round(time * original.rate_hz) + (lined ? original.worst_frame : 0);
      return [frame, Math.max(0, Math.min(original.frame_count - 1, other))];
    };
    assert.deepEqual(await frames(), expected(minimal.worst_frame));
    const before = await picture(page);
    await page.locator('.scrub').fill('0');
    await page.keyboard.press('Escape');
    await page.waitForSelector('.card:visible');
    await page.keyboard.press('Enter');
    await ready(page);
    await page.keyboard.press('s');
    await ready(page, 'both');
    assert.ok(before.equals(await picture(page)), 'opened again, the same picture');
    await page.locator('.scrub').fill('0');
    await page.selectOption('.speed', '0.25');
    await page.locator('.play').click();
    await page.waitForFunction(() => Number(document.querySelector('.scrub').value) >= 5);
    await page.locator('.play').click();
    await page.waitForFunction(() => document.querySelector('.play').textContent === 'Play');
    await settle(page);
    const stopped = await shownFrame(page);  // which may be the frame that was shown before
    assert.deepEqual(await frames(), expected(stopped));
    assert.equal(before.equals(await picture(page)), stopped === minimal.worst_frame);
    await page.locator('[data-motion=original]').click();
    await ready(page, String(cases.get(withOriginal).motions.indexOf(original)));
    assert.equal(await shownFrame(page), Math.max(0, original.worst_frame));
    assert.deepEqual(wrong, []);
    await close();
  });

  const specName = `${way}: the spec is complete, free fields are grey, and it is copied`;
  test(specName, need(withFree, 'free fields'), async () => {
    const { page, wrong, close } = await openCase(await start(), withFree);
    const motion = cases.get(withFree).motions[0];
    const text = await page.locator('.spec pre').textContent();
    assert.deepEqual(JSON.parse(text), JSON.parse(JSON.stringify(motion.spec)));
    assert.ok(await page.locator('.spec pre .free').count() > 0);
    assert.ok(await page.locator('.free-note').isVisible());
    await page.locator('.spec .copy').click();
    await page.waitForFunction(() => document.querySelector('.spec .copy').textContent === 'Copied');
    assert.deepEqual(wrong, []);
    await close();
  });
}

test('many cases one after the other keep one drawing context', need(any, 'a motion'), async () => {
  const { page, wrong, close } = await openCase(await urlOf('file', copyOf(options.report)), any);
  for (let i = 0; i < 20; ++i) {
    await page.keyboard.press('Escape');
    await page.waitForSelector('.card:visible');
    await page.keyboard.press('Enter');
    await ready(page);
  }
  assert.equal(await page.locator('canvas.stage-canvas').count(), 1);
  assert.deepEqual(wrong, [], 'no warning about too many contexts');
  await close();
});

// Pixels that are near a colour.
async function countColour(page, png, [r, g, b]) {
  return page.evaluate(async ([data, wanted]) => {
    const image = new Image();
    image.src = data;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = context.getImageData(0, 0, image.width, image.height).data;
    let found = 0;
    for (let i = 0; i < pixels.length; i += 4)
      found += wanted.every((value, k) => Math.abs(pixels[i + k] - value) < 12) ? 1 : 0;
    return found;
  }, [`data:image/png;base64,${png.toString('base64')}`, [r, g, b]]);
}
