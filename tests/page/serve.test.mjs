// `contort serve` itself, from a click to the next report.
import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { openApiValidator, openPage, options, seriousProblems, settle } from './support.mjs';

const canServe = options.contort && spawnSync(options.contort, ['serve', '--help']).status === 0 &&
  existsSync(join(dirname(options.contort), 'page', 'play.html'));
const need = { skip: canServe ? false : 'no --contort that serves pages' };
const kPatience = { timeout: 120_000 };
let scratch;
let server;
let url;

before(async () => {
  if (need.skip) return;
  scratch = mkdtempSync(join(tmpdir(), 'serve_'));
  const corpus = join(scratch, 'corpus');
  execFileSync(options.contort, ['fuzz', '--cases', '0', '--corpus', corpus], { stdio: 'ignore' });  // an empty one
  server = spawn(options.contort, ['serve', '--corpus', corpus, '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  process.on('exit', () => server.kill());  // also where this process ends before after() is called
  url = await new Promise((done, failed) => {
    let said = '';
    server.stdout.on('data', (text) => {
      said += text;
      const found = /http:\/\/[^\s/]+\//.exec(said);
      if (found) done(found[0]);
    });
    server.on('exit', (code) => failed(new Error(`contort serve ended with ${code}`)));
  });
});

after(async () => {
  if (!server) return;
  server.removeAllListeners('exit');
  if (server.exitCode === null && server.signalCode === null) {  // else nothing would ever be heard of it
    const ended = new Promise((done) => { server.on('exit', done); });
    server.kill();
    await ended;
  }
  rmSync(scratch, { recursive: true, force: true });
});

test('the document of the calls is OpenAPI 3.1', need, async () => {
  const Validator = await openApiValidator();
  const document = await (await fetch(`${url}api`)).json();
  const found = await new Validator().validate(document);
  assert.deepEqual(found.errors ?? [], []);
  assert.ok(found.valid);
  delete document.info.version;
  assert.equal((await new Validator().validate(document)).valid, false, 'one without a version is not');
});

const api = async (path) => (await fetch(`${url}api/${path}`)).json();

async function openPlay(more = {}, hash = '') {
  const opened = await openPage(`${url}play${hash}`, more);
  opened.page.setDefaultTimeout(60_000);  // Motions are computed, here while others are, too.
  await opened.page.waitForSelector('.stage[data-ready]');
  await settle(opened.page);
  return opened;
}

const sessionId = (page) => page.evaluate(() => window.contortPlay.session.id);

// A place on the screen where a joint with that beginning is, or, without a name, where no body is. Not near an edge.
const placeOn = (page, wanted) => page.evaluate((name) => {
  const { stage, pointer } = window.contortPlay;
  stage.element.scrollIntoView({ block: 'nearest' });
  const box = stage.drawing.canvas.getBoundingClientRect();
  const jointAt = (x, y) => pointer.hit(stage.at(x, y))?.joint.userData.of.name;
  for (let i = 4; i < 60; ++i)
    for (let j = 4; j < 50; ++j) {
      const [x, y] = [box.left + box.width * i / 64, box.top + box.height * j / 64];
      const found = [[0, 0], [5, 0], [-5, 0], [0, 5], [0, -5]].map(([dx, dy]) => jointAt(x + dx, y + dy) ?? '');
      if (found.every((joint) => (name ? joint.startsWith(name) : joint === ''))) return { x, y };
    }
  return null;
}, wanted);

async function pause(page) {
  await page.locator('.controls .play', { hasText: 'Pause' }).click();
  await page.waitForSelector('.controls .play:has-text("Play")');
  await settle(page);
}

test('what is shown is what contort generate makes of the spec', need, async () => {
  const { page, wrong, close } = await openPlay();
  await page.getByRole('button', { name: 'Queue it' }).click();
  await page.locator('.queue li').first().waitFor();
  await page.waitForFunction(() => window.contortPlay.tracks.last() > 60);
  const state = await api(`sessions/${await sessionId(page)}`);
  const spec = join(scratch, 'spec.json');
  writeFileSync(spec, JSON.stringify({ ...state.spec, dynamics: { ...state.spec.dynamics, mode: 'dynamic' } }));
  const told = execFileSync(options.contort, ['generate', spec, '-o', join(scratch, 'out.json')], { encoding: 'utf8' });
  assert.match(told, new RegExp(state.motion_hashes.dynamic));
  const joints = await page.evaluate(() => window.contortPlay.tracks.pose('dynamic', 30).length / 7);
  assert.equal(joints, (await api(`sessions/${await sessionId(page)}/model`)).joints.length);
  assert.deepEqual(wrong, []);
  await close();
});

test('a push falls into the next report', need, async (t) => {
  const report = await openPage(url);
  const { page, wrong, close } = await openPlay();
  await page.getByRole('combobox', { name: 'arm_right', exact: true }).selectOption('mech_arm_extend');
  await page.waitForFunction(() => window.contortPlay.tracks.take === 2);
  await page.waitForFunction(() => window.contortPlay.model.joints.some(({ name }) => name === 'arm_right/extend'));
  await pause(page);

  const free = await placeOn(page, '');
  await page.mouse.click(free.x, free.y);
  await page.getByText(/^arm_right \/ .* m$/).waitFor();
  const aimed = await api(`sessions/${await sessionId(page)}`);
  assert.ok(JSON.stringify(aimed.spec).includes('"aim"'));

  // Hard enough to be found, and not so hard that nobody would withstand it: 60 to 350 N s.
  await page.getByLabel('A drag of 1 m is, N s').fill('300');
  // The camera follows a mean of frames before and after: it moves when the aim's have come.
  await page.waitForFunction(() => {
    const { session, tracks } = window.contortPlay;
    return [...tracks.of.values()].every(({ revision }) => revision >= session.state.revision);
  });
  await settle(page);
  const torso = await placeOn(page, 'torso/');
  await page.mouse.move(torso.x, torso.y);
  await page.mouse.down();
  await page.mouse.move(torso.x + 60, torso.y + 4, { steps: 4 });
  await page.mouse.move(torso.x + 120, torso.y + 8, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => window.contortPlay.session.state.spec.dynamics?.impacts?.length === 1);
  await page.locator('.controls .play').click();
  const row = page.locator('.finding').last();
  await row.waitFor();
  await row.getByRole('button', { name: /^Save/ }).click();
  await row.getByText(/^Saved/).waitFor();
  await row.getByRole('button', { name: /^Shrink/ }).click();
  await row.getByText('Shrink: done').waitFor(kPatience);
  t.diagnostic(await row.locator('.job').textContent());
  await row.getByRole('button', { name: 'Add to the report' }).click();
  const link = row.getByRole('link', { name: 'Open in the report' });
  await link.waitFor(kPatience);
  const key = new URLSearchParams((await link.getAttribute('href')).split('#')[1]).get('case');
  const stored = await api(`corpus/${encodeURIComponent(key)}`);
  assert.equal(stored.bucket, key);
  assert.ok(stored.cases.min.spec);

  // Both: the report that was open before, and the one behind the link.
  if (await report.page.locator('#failures').count())
    await report.page.locator(`.bucket[data-case="${key}"] .live-bar`).waitFor({ state: 'attached', ...kPatience });
  await page.goto(`${url}#case=${encodeURIComponent(key)}`);
  await page.waitForSelector('.case[data-ready="0"]', kPatience);
  assert.deepEqual([...wrong, ...report.wrong], []);
  await close();

  const again = await openPlay({}, `#case=${encodeURIComponent(key)}`);
  assert.equal(await again.page.locator('.about a').textContent(), key);
  await again.page.locator('.controls .play').click();
  await again.page.locator('.finding').first().waitFor();
  assert.deepEqual(again.wrong, []);
  await again.close();
  await report.close();
});

test('triage from the report is kept, and every open report shows it', need, async () => {
  const { buckets } = await api('corpus');
  assert.ok(buckets.length > 0, 'the test before kept one');
  const key = buckets[0].bucket;
  const [one, two] = [await openPage(url), await openPage(url)];
  const row = (page) => page.locator(`.bucket[data-case="${key}"]`);
  await row(one.page).getByRole('button', { name: 'Acknowledge' }).click();
  await row(one.page).getByLabel('Owner').fill('ana');
  await row(one.page).getByLabel('Ticket').fill('<b>12</b>');
  await one.page.keyboard.press('Enter');
  await row(one.page).getByText('ana looks after it').waitFor();
  const { state, owner, ticket } = await api(`corpus/${encodeURIComponent(key)}`);
  assert.deepEqual([state, owner, ticket], ['open', 'ana', '<b>12</b>']);
  for (const { page } of [one, two])
    await page.locator('.card', { has: page.locator(`.bucket[data-case="${key}"]`) }).locator('.chip', { hasText: 'open' }).waitFor(kPatience);
  assert.deepEqual([...one.wrong, ...two.wrong], []);
  await one.close();
  await two.close();
});

test('two browsers do not disturb each other', need, async () => {
  const [one, two] = [await openPlay(), await openPlay()];
  const hash = async ({ page }) => (await api(`sessions/${await sessionId(page)}`)).motion_hashes;
  const before = await hash(one);
  await two.page.getByRole('combobox', { name: 'Character', exact: true }).selectOption('quadruped');
  await two.page.waitForFunction(() => window.contortPlay.session.state.spec.character.name === 'quadruped');
  await two.page.getByRole('button', { name: 'Queue it' }).click();
  await two.page.locator('.queue li').first().waitFor();
  assert.deepEqual(await hash(one), before);
  assert.deepEqual([...one.wrong, ...two.wrong], []);
  await one.close();
  await two.close();
});

test('every kind of ground, obstacle and load builds', need, async () => {
  const { page, wrong, close } = await openPlay();
  await page.getByText('Surroundings').click();
  const changed = async (act) => {
    const before = await page.evaluate(() => window.contortPlay.tracks.take);
    await act();
    await page.waitForFunction((take) => window.contortPlay.tracks.take > take, before);
    assert.ok(await page.locator('.seen > .problem').isHidden(), await page.locator('.seen > .problem').textContent());
  };
  for (const ground of ['slope', 'steps', 'heights', 'plane'])
    await changed(() => page.getByRole('combobox', { name: 'Ground' }).selectOption(ground));
  for (const kind of ['wall', 'box', 'ball', 'pole']) {
    await page.getByRole('combobox', { name: 'Obstacle' }).selectOption(kind);
    await changed(() => page.getByRole('button', { name: 'Put up' }).click());
  }
  await changed(() => page.getByRole('button', { name: 'Hang', exact: true }).click());
  await changed(() => page.getByRole('button', { name: 'Attach' }).click());
  await changed(() => page.getByLabel('kinematic').check());
  await changed(() => page.getByLabel('tracking').check());
  assert.equal(await page.locator('.pane-label').count(), 3);
  assert.deepEqual(wrong, []);
  await close();
});

test('an error is the server\u2019s sentence', need, async () => {
  const { page, close } = await openPlay();
  await page.evaluate(() => window.contortPlay.command('aim', { slot: 'leg_left', target_m: [0, 1, 2] }));
  assert.ok((await page.locator('.seen > .problem').textContent()).length > 10);
  await page.getByRole('button', { name: 'Queue it' }).click();
  await page.waitForSelector('.seen > .problem', { state: 'hidden' });
  await close();
});

test('the served pages have no serious problem', need, async () => {
  const play = await openPlay({ bypassCSP: true });
  assert.deepEqual(await seriousProblems(play.page), []);
  await play.close();
  const report = await openPage(url, { bypassCSP: true, scheme: 'dark' });
  assert.deepEqual(await seriousProblems(report.page), []);
  await report.close();
});
