// A report that a server shows: triage from its rows, and a list that changes when the report does.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { MockServer } from './mock_server.mjs';
import { copyOf, findCase, openPage, options, readCases, ready, seriousProblems } from './support.mjs';

const cases = readCases(options.report);
const any = findCase(cases, () => true);
const need = { skip: options.contort && options.viewer && any ? false : 'no --contort and --viewer' };
const kHostile = '<script>alert(1)</script>';
let mock;

before(async () => {
  if (need.skip) return;
  mock = await new MockServer({ contort: options.contort, pages: options.viewer, report: copyOf(options.report) }).start();
});
after(() => mock?.stop());

async function openLive(more = {}, hash = '') {
  mock.commands.length = 0;
  const opened = await openPage(`${mock.url}${hash}`, more);
  await opened.page.waitForSelector('.live-bar', { state: 'attached' });
  return opened;
}

const bucket = (page, key = any) => page.locator(`main.page .bucket[data-case="${key}"]`);

// Another report: `change` of its page's text.
function remake(change) {
  const file = join(mock.report, 'index.html');
  writeFileSync(file, change(readFileSync(file, 'utf8')));
  mock.tell('report', { revision: ++mock.reports });
}

// The page with one more failure in front.
const withFailure = (key, subject) => (text) => text.replace('<article', `<article tabindex='-1' class='card gating' data-check='pop' ` +
  `data-character='human' data-parts='head' data-state='new'><div class='head'><h3><span class='check'>pop</span> ` +
  `<span class='subject'>${subject}</span></h3></div><section class='bucket' data-case='${key}'>` +
  `<button type='button' class='open'>Look closer</button></section></article>\n<article`);

test('every bucket has its buttons, and a way to the playground', need, async () => {
  const { page, wrong, close } = await openLive();
  const buckets = await page.locator('.bucket[data-case]').count();
  assert.equal(await page.locator('.bucket > .live-bar').count(), buckets);
  assert.equal(await bucket(page).getByRole('link', { name: 'Open in playground' }).getAttribute('href'), `/play#case=${encodeURIComponent(any)}`);
  assert.equal(await page.locator('.live-top a').getAttribute('href'), '/play');
  assert.deepEqual(wrong, []);
  await close();
});

test('acknowledge, quarantine and note send what was written', need, async () => {
  const { page, wrong, close } = await openLive();
  const row = bucket(page);
  const sent = async (button, values, told) => {
    mock.commands.length = 0;
    await row.getByRole('button', { name: button, exact: true }).click();
    for (const [name, value] of Object.entries(values)) await row.getByLabel(name, { exact: true }).fill(value);
    await page.keyboard.press('Enter');
    await row.getByText(told).waitFor();
    assert.equal(await row.locator('form').count(), 0);
    assert.equal(await page.evaluate(() => document.activeElement.textContent), button, 'the focus is back on the button');
    return mock.commands.at(-1);
  };
  const tomorrow = new Date(Date.now() + 86_400_000).toISOString().slice(0, 10);
  assert.deepEqual(await sent('Acknowledge', { Owner: 'ana', Ticket: 'T-12' }, 'ana looks after it'),
    { name: 'acknowledge', bucket: any, body: { owner: 'ana', ticket: 'T-12' } });
  assert.deepEqual((await sent('Quarantine', { Owner: 'ana', Reason: kHostile, 'Last day': tomorrow }, `until ${tomorrow}`)).body,
    { owner: 'ana', reason: kHostile, expires: tomorrow });
  assert.deepEqual((await sent('Note', { Note: kHostile }, 'The note is kept')).body, { text: kHostile });
  await row.getByRole('button', { name: 'Acknowledge' }).click();
  assert.equal(await row.getByLabel('Owner').inputValue(), 'ana', 'who it was is remembered');
  await page.keyboard.press('Escape');
  assert.equal(await row.locator('form').count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test('replay and shrink show how far they are, errors their sentence', need, async () => {
  const { page, close } = await openLive();
  const row = bucket(page);
  mock.held = true;
  await row.getByRole('button', { name: 'Shrink' }).click();
  await row.getByText('Shrink: running').waitFor();
  mock.held();
  mock.held = null;
  await row.getByText('Shrink: done').waitFor();
  mock.faults.push({ path: '/replay', status: 409, text: `It runs already ${kHostile}.`, times: 1 });
  await row.getByRole('button', { name: 'Replay', exact: true }).click();
  await row.getByText(`It runs already ${kHostile}.`).waitFor();
  await close();
});

test('a server that only shows has no buttons that write', need, async () => {
  mock.catalogue.read_only = true;
  const { page, wrong, close } = await openLive();
  assert.equal(await page.locator('.live-bar button').count(), 0);
  assert.ok(await page.locator('.live-play').count() > 0);
  assert.ok(!await page.getByRole('button', { name: 'Make the report anew' }).isVisible());
  assert.deepEqual(wrong, []);
  await close();
  mock.catalogue.read_only = false;
});

test('an open case has the buttons, too', need, async () => {
  const { page, wrong, close } = await openLive({}, `#case=${encodeURIComponent(any)}`);
  await ready(page);
  await page.locator('#case .live-bar').getByRole('button', { name: 'Note' }).click();
  await page.locator('#case').getByRole('textbox', { name: 'Note' }).fill('seen');
  await page.keyboard.press('Enter');
  await page.locator('#case').getByText('The note is kept').waitFor();
  assert.deepEqual(wrong, []);
  await close();
});

test('a new report takes the place of the old list; filter, focus and what is being written stay', need, async () => {
  const { page, wrong, close } = await openLive();
  await page.locator('#words').fill('a');
  const row = bucket(page);
  await row.getByRole('button', { name: 'Acknowledge' }).click();
  await row.getByLabel('Ticket').fill('T-77');
  const before = await row.evaluate((element) => element.getBoundingClientRect().top);
  const shown = await page.locator('.card:visible').count();
  remake(withFailure('pop-00000001', 'head/a &lt;script&gt;alert(1)&lt;/script&gt;'));
  await page.getByText('Report updated: 1 new failure', { exact: true }).waitFor();
  assert.equal(await page.locator('#words').inputValue(), 'a');
  assert.equal(await page.locator('.card:visible').count(), shown + 1);
  assert.equal(await row.getByLabel('Ticket').inputValue(), 'T-77');
  assert.ok(await row.getByLabel('Ticket').evaluate((element) => element === document.activeElement), 'the focus stays');
  assert.ok(Math.abs(await row.evaluate((element) => element.getBoundingClientRect().top) - before) < 2, 'nothing jumps');
  assert.equal(await bucket(page, 'pop-00000001').locator('.live-bar').count(), 1);
  await page.locator('#words').fill('head/a');
  assert.equal(await page.locator('.card:visible').count(), 1);
  await page.locator('#words').fill('acknowledge');
  assert.equal(await page.locator('.card:visible').count(), 0, 'buttons are not what is filtered');
  assert.deepEqual(wrong, []);
  await close();
});

test('a bucket that changed is shown as it is now, with its open form; one that is gone goes', need, async () => {
  const { page, wrong, close } = await openLive();
  const row = bucket(page);
  await row.getByRole('button', { name: 'Note' }).click();
  await row.getByRole('textbox', { name: 'Note' }).fill('half');
  const card = page.locator('.card', { has: page.locator(`.bucket[data-case="${any}"]`) });
  remake((text) => {
    const at = text.lastIndexOf('<article', text.indexOf(`data-case='${any}'`));
    return `${text.slice(0, at)}${text.slice(at).replace(/class='summary'>/, "class='summary'>changed ")}`;
  });
  await card.getByText('changed').waitFor();
  assert.equal(await row.getByRole('textbox', { name: 'Note' }).inputValue(), 'half');
  assert.ok(await row.getByRole('textbox', { name: 'Note' }).evaluate((element) => element === document.activeElement));
  remake((text) => text.replace(/<article[^]*?<\/article>\n/, ''));
  await page.getByText(/1 gone/).waitFor();
  assert.deepEqual(wrong, []);
  await close();
});

test('a new report leaves the open case open', need, async () => {
  const { page, wrong, close } = await openLive({}, `#case=${encodeURIComponent(any)}`);
  await ready(page);
  remake(withFailure('pop-00000002', 'tail'));
  await page.getByText('Report updated: 1 new failure').waitFor();
  assert.ok(await page.locator('#case .stage-canvas').isVisible());
  await page.locator('.case .close').click();
  await bucket(page, 'pop-00000002').waitFor();
  assert.deepEqual(wrong, []);
  await close();
});

for (const [scheme, width] of [['light', 1280], ['dark', 375]]) {
  test(`${scheme}, ${width} wide: the live report has no serious problem`, need, async () => {
    const { page, close } = await openLive({ scheme, width, bypassCSP: true });
    await bucket(page).getByRole('button', { name: 'Quarantine' }).click();
    assert.deepEqual(await seriousProblems(page), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
    await close();
  });
}
