// The playground against a server with made-up motion: every command that it sends, and what it does on bad days.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { MockServer } from './mock_server.mjs';
import { openPage, options, picture, seriousProblems, settle } from './support.mjs';

const need = { skip: options.contort && options.viewer ? false : 'no --contort and --viewer' };
const kHostile = '<img src=x onerror=alert(1)>';
let mock;

before(async () => {
  if (!need.skip) mock = await new MockServer({ contort: options.contort, pages: options.viewer, report: options.report }).start();
});
after(() => mock?.stop());

// A playground with its picture. `more` as of openPage.
async function openPlay(more = {}, hash = '') {
  mock.commands.length = 0;
  const opened = await openPage(`${mock.url}play${hash}`, more);
  await playReady(opened.page);
  return opened;
}

async function playReady(page) {
  await page.waitForSelector('.stage[data-ready]');
  await page.waitForFunction(() => /frame [1-9]/.test(document.querySelector('.frame-text').textContent));
  await settle(page);
}

async function commandOf(name) {
  for (let i = 0; i < 100; ++i) {
    const found = mock.commands.findLast((one) => one.name === name);
    if (found) return found.body;
    await new Promise((done) => { setTimeout(done, 50); });
  }
  return assert.fail(`the page sent no ${name}`);
}

const sessionOf = () => [...mock.sessions.values()].at(-1);
const pause = async (page) => {
  await page.locator('.controls .play', { hasText: 'Pause' }).click();
  await page.waitForSelector('.controls .play:has-text("Play")');
  await settle(page);
};

// Waits until the page has the motion of the last command, also in later frames, because the camera follows a mean.
async function caughtUp(page) {
  await page.waitForFunction((revision) => [...window.contortPlay.tracks.of.values()].every((track) => track.revision >= revision),
    sessionOf().revision);
  await settle(page);
}

// A place on the screen where the body is, or is not, with the name of the joint.
const placeOn = (page, body) => page.evaluate((wanted) => {
  const { stage, pointer } = window.contortPlay;
  stage.element.scrollIntoView({ block: 'nearest' });
  const box = stage.drawing.canvas.getBoundingClientRect();
  const jointAt = (x, y) => pointer.hit(stage.at(x, y))?.joint.userData.of.name;
  for (let i = 4; i < 36; ++i)
    for (let j = 4; j < 30; ++j) {
      const [x, y] = [Math.round(box.left + box.width * i / 40), Math.round(box.top + box.height * j / 40)];
      const joint = jointAt(x, y);
      const around = [[6, 0], [-6, 0], [0, 6], [0, -6]].every(([dx, dy]) => jointAt(x + dx, y + dy) === joint);
      if (around && Boolean(joint) === wanted) return { x, y, joint };
    }
  return null;
}, body);

test('a session opens and its frames are shown as they come', need, async () => {
  const { page, wrong, close } = await openPlay();
  const first = await picture(page);
  await page.waitForTimeout(600);
  assert.notDeepEqual(await picture(page), first, 'it moves');
  const session = sessionOf();
  await pause(page);
  const shown = Number(/frame (\d+)/.exec(await page.locator('.frame-text').textContent())[1]);
  assert.ok(Math.abs(shown - session.frame()) <= 12, `${shown} is about ${session.frame()}`);
  const off = await page.evaluate(() => {
    const { stage, tracks, frame } = window.contortPlay;
    const [pane] = stage.panes;
    const sent = tracks.pose(pane.mode, frame);
    return pane.order.reduce((most, joint, i) => Math.max(most,
      Math.abs(joint.position.x - sent[7 * i]), Math.abs(joint.quaternion.x - sent[7 * i + 3])), 0);
  });
  assert.ok(off < 1e-6, 'the joints are where the server said');
  assert.deepEqual(wrong, []);
  await close();
});

test('a click aims, a drag on the body pushes', need, async () => {
  const { page, wrong, close } = await openPlay();
  await pause(page);
  const free = await placeOn(page, false);
  await page.mouse.click(free.x, free.y);
  const aim = await commandOf('aim');
  assert.match(aim.slot, /^arm_/);
  assert.equal(aim.target_m.length, 3);
  const fields = await page.locator('form[aria-label="Aim"] input[aria-label^="Target"]').evaluateAll((all) => all.map((one) => Number(one.value)));
  fields.forEach((value, i) => assert.ok(Math.abs(value - aim.target_m[i]) < 1e-3));

  const pushed = async (length) => {
    await caughtUp(page);
    const body = await placeOn(page, true);
    mock.commands.length = 0;
    await page.mouse.move(body.x, body.y);
    await page.mouse.down();
    await page.mouse.move(body.x + length / 2, body.y, { steps: 3 });
    await page.mouse.move(body.x + length, body.y, { steps: 3 });
    assert.match(await page.locator('.pushing').textContent(), new RegExp(`N s on ${body.joint}$`));
    await page.mouse.up();
    const push = await commandOf('push');
    assert.equal([push.slot, push.joint].filter(Boolean).join('/').replace(/^waist$/, 'root'), body.joint);
    return push;
  };
  const [short, long] = [await pushed(40), await pushed(80)];
  const ratio = Math.hypot(...long.impulse_N_s) / Math.hypot(...short.impulse_N_s);
  assert.ok(ratio > 1.6 && ratio < 2.4, `twice the drag is twice the impulse: ${ratio}`);
  assert.ok(Math.hypot(...short.point_m) < 2, 'the point is in the frame of the joint');

  await caughtUp(page);
  const body = await placeOn(page, true);
  mock.commands.length = 0;
  await page.mouse.move(body.x, body.y);
  await page.mouse.down();
  await page.mouse.move(body.x + 50, body.y, { steps: 3 });
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await page.waitForTimeout(200);
  assert.equal(mock.commands.length, 0, 'Escape lets go');
  assert.deepEqual(wrong, []);
  await close();
});

test('a clip is made with forms, queued, and interrupts', need, async () => {
  const { page, wrong, close } = await openPlay();
  const make = page.getByRole('form', { name: 'Make a clip' });
  await make.getByLabel('speed_m_s').fill('1.5');
  await make.getByRole('button', { name: 'Add an action at the same time' }).click();
  const second = make.getByRole('group', { name: 'Action 2' });
  await second.getByLabel('Slot').selectOption('head');
  await second.getByLabel('Action').selectOption('direction');
  await second.getByLabel('azimuth_deg').fill('30');
  await make.getByLabel('Name, for reports').fill('stroll');
  await make.getByRole('button', { name: 'Queue it' }).click();
  const { sequence } = await commandOf('enqueue');
  assert.equal(sequence.name, 'stroll');
  assert.deepEqual(sequence.clips[0].actions.map(({ action, slot, params, duration_frames: frames }) => ({ action, slot, params, frames })), [
    { action: 'walk', slot: 'waist', params: { speed_m_s: 1.5 }, frames: 180 },
    { action: 'direction', slot: 'head', params: { azimuth_deg: 30 }, frames: 60 }]);
  await page.locator('.queue li', { hasText: 'walk on waist' }).waitFor();
  await make.getByLabel('speed_m_s').fill('99');
  mock.commands.length = 0;
  await make.getByRole('button', { name: 'Queue it' }).click();
  await page.waitForTimeout(200);
  assert.equal(mock.commands.length, 0, 'not out of its range');
  await make.getByLabel('speed_m_s').fill('');
  await make.getByLabel('Go on afterwards').uncheck();
  await make.getByRole('button', { name: 'Interrupt with it' }).click();
  assert.equal((await commandOf('interrupt')).resume, false);
  assert.deepEqual(wrong, []);
  await close();
});

test('parts, objects, loads, surroundings and modes change', need, async () => {
  const { page, wrong, close } = await openPlay();
  await page.getByRole('combobox', { name: 'arm_left', exact: true }).selectOption('mech_arm_shield');
  assert.deepEqual((await commandOf('change')).character.parts, { arm_left: 'mech_arm_shield' });
  await page.waitForFunction(() => window.contortPlay.tracks.take === 2);
  const changed = async (act) => {
    mock.commands.length = 0;
    await act();
    return commandOf('change');
  };
  await page.getByRole('form', { name: 'Hang a load' }).getByLabel('Mass, kg').fill('40');
  const { loads } = await changed(() => page.getByRole('button', { name: 'Hang', exact: true }).click());
  assert.equal(loads[0].mass_kg, 40);
  assert.ok(loads[0].slot && loads[0].socket);
  await page.getByText('Surroundings').click();
  const { environment } = await changed(() => page.getByRole('combobox', { name: 'Ground' }).selectOption('steps'));
  assert.equal(environment.ground.type, 'steps');
  assert.equal(environment.ground.count, 5);
  const wall = await changed(() => page.getByRole('button', { name: 'Put up' }).click());
  assert.equal(wall.environment.obstacles[0].shape.type, 'box');
  const { modes } = await changed(() => page.getByLabel('kinematic').check());
  assert.deepEqual(modes, ['kinematic', 'dynamic']);
  await page.waitForFunction(() => document.querySelectorAll('.pane-label').length === 2);
  assert.deepEqual(await page.locator('.pane-label').allTextContents(), ['kinematic', 'dynamic']);
  assert.deepEqual(wrong, []);
  await close();
});

test('a finding appears when it happens, becomes a case, is shrunk, and is linked', need, async () => {
  mock.subject = kHostile;
  const { page, wrong, close } = await openPlay();
  const row = page.locator('.finding').first();
  await row.waitFor();
  assert.ok((await row.textContent()).includes(kHostile), 'a hostile name is text');
  assert.ok((await page.locator('.curve-title').textContent()).includes(kHostile));
  await row.getByRole('button', { name: /^Look/ }).click();
  await page.waitForFunction(() => /frame 30 .*looking back/.test(document.querySelector('.frame-text').textContent));
  await row.getByRole('button', { name: /^Save/ }).click();
  await row.getByText('Saved as a new bucket: joint_range-0123abcd').waitFor();
  await row.getByRole('button', { name: /^Shrink/ }).click();
  await row.getByText('Shrink: running').waitFor();
  await row.getByText('Shrink: done').waitFor();
  await row.getByRole('button', { name: 'Add to the report' }).click();
  assert.equal(await row.getByRole('link', { name: 'Open in the report' }).getAttribute('href'), '/#case=joint_range-0123abcd');
  assert.deepEqual(wrong, []);
  await close();
  mock.subject = undefined;
});

test('the address opens the case of a bucket', need, async () => {
  mock.corpus.set('pop-77', { bucket: 'pop-77', cases: { min: { spec: {
    format: 'contort.spec/1', character: { name: 'human' }, dynamics: { mode: 'tracking' } } } } });
  const { page, wrong, close } = await openPage(`${mock.url}play#case=pop-77`);
  await page.waitForSelector('.stage[data-ready]');
  assert.equal(sessionOf().spec.character.name, 'human');
  assert.deepEqual(sessionOf().modes, ['tracking']);
  assert.equal(await page.locator('.about a').getAttribute('href'), '/#case=pop-77');
  assert.deepEqual(wrong, []);
  await close();
});

test('a press of Play waits until the session is open', need, async () => {
  mock.corpus.set('pop-77', { bucket: 'pop-77', cases: { min: { spec: {
    format: 'contort.spec/1', character: { name: 'human' } } } } });
  mock.commands.length = 0;
  mock.faults.push({ path: '/api/sessions', status: 429, text: 'Too many sessions.', retry_after: 2, times: 1 });
  const { page, wrong, close } = await openPage(`${mock.url}play#case=pop-77`);
  await page.getByText('Too many sessions.').waitFor();
  assert.equal(await page.locator('.controls .play').isDisabled(), true);
  await page.keyboard.press(' ');
  await page.locator('.controls .play').click();
  await page.waitForFunction(() => /frame [1-9]/.test(document.querySelector('.frame-text').textContent));
  assert.deepEqual(mock.commands.filter(({ name }) => name === 'clock').map(({ body }) => body), [{ play: true }]);
  assert.deepEqual(wrong.filter((text) => !/429/.test(text)), []);
  await close();
});

test('a busy server is asked again, an error is told in its words', need, async () => {
  const { page, close } = await openPlay();
  mock.faults.push({ path: '/clock', status: 429, text: 'Too many calls from here.', retry_after: 1, times: 1 });
  await page.locator('.controls .play').click();
  await page.getByText('Too many calls from here. Trying again in 1 s.').waitFor();
  await page.waitForSelector('.controls .play:has-text("Play")');
  mock.faults.push({ path: '/aim', status: 422, text: `No such target ${kHostile}.`, times: 1 });
  const free = await placeOn(page, false);
  await page.mouse.click(free.x, free.y);
  await page.getByText(`No such target ${kHostile}.`).waitFor();
  await page.mouse.click(free.x, free.y);
  await page.waitForSelector('.problem', { state: 'hidden' });
  await close();
});

test('a lost connection is said, and the session goes on', need, async () => {
  const { page, close } = await openPlay();
  const session = sessionOf();
  mock.faults.push({ path: '/stream', status: 503, times: 1 });
  for (const stream of session.streams) stream.end();
  await page.getByText('The connection to the server is lost').waitFor();
  await page.getByText('Connected.').waitFor();
  await page.waitForSelector('.problem', { state: 'hidden' });
  mock.forget();
  await page.getByText('It begins again').waitFor();
  await page.waitForFunction(() => window.contortPlay.tracks.last() > 0);
  assert.equal(sessionOf().spec.character.name, 'mech');
  await close();
});

test('loading the page again goes on with the session', need, async () => {
  const { page, wrong, close } = await openPlay();
  const { id } = sessionOf();
  await page.reload();
  await playReady(page);
  assert.equal(await page.evaluate(() => window.contortPlay.session.id), id);
  // The stream began at the clock: what was before is asked for when somebody looks at it.
  assert.ok(await page.evaluate(() => !window.contortPlay.tracks.of.get('dynamic').frames[3]));
  await page.evaluate(() => window.contortPlay.look(3));
  await page.waitForFunction(() => window.contortPlay.tracks.of.get('dynamic').frames[3]);
  await page.waitForFunction(() => /frame 3 .*looking back/.test(document.querySelector('.frame-text').textContent));
  assert.deepEqual(wrong, []);
  await close();
});

test('keys: play, step, look back, restart', need, async () => {
  const { page, wrong, close } = await openPlay();
  const frame = async () => Number(/frame (\d+)/.exec(await page.locator('.frame-text').textContent())[1]);
  await page.keyboard.press(' ');
  await page.waitForSelector('.controls .play:has-text("Play")');
  await settle(page);
  const at = await frame();
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((next) => document.querySelector('.frame-text').textContent.includes(`frame ${next} `), at + 1);
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction((next) => document.querySelector('.frame-text').textContent.includes(`frame ${next} `), at);
  await page.keyboard.press('n');
  await page.waitForFunction((next) => document.querySelector('.frame-text').textContent.includes(`frame ${next} `), at + 1);
  await page.keyboard.press('Home');
  await page.waitForFunction(() => document.querySelector('.frame-text').textContent.includes('frame 0 '));
  assert.deepEqual(wrong, []);
  await close();
});

test('without WebGL it is drawn flat, and a click aims', need, async () => {
  const { page, close } = await openPlay({ gl: false });
  assert.match(await page.locator('.stage-sentence').textContent(), /cannot draw in 3-D/);
  await pause(page);
  const free = await placeOn(page, false);
  await page.mouse.click(free.x, free.y);
  assert.equal((await commandOf('aim')).target_m.length, 3);
  await close();
});

test('two browsers do not disturb each other', need, async () => {
  const one = await openPlay();
  const two = await openPlay();
  assert.equal(new Set(await Promise.all([one, two].map(({ page }) => page.evaluate(() => window.contortPlay.session.id)))).size, 2);
  await two.page.getByRole('combobox', { name: 'Character', exact: true }).selectOption('quadruped');
  await two.page.waitForFunction(() => window.contortPlay.session.state.spec.character.name === 'quadruped');
  assert.equal(await one.page.evaluate(() => window.contortPlay.session.state.spec.character.name), 'mech');
  assert.deepEqual([...one.wrong, ...two.wrong], []);
  await one.close();
  await two.close();
});

test('a server that only shows offers no saving', need, async () => {
  mock.catalogue.read_only = true;
  const { page, wrong, close } = await openPlay();
  await page.locator('.finding').first().waitFor();
  assert.equal(await page.getByRole('button', { name: /^Save/ }).count(), 0);
  assert.deepEqual(wrong, []);
  await close();
  mock.catalogue.read_only = false;
});

for (const [scheme, width] of [['light', 1280], ['dark', 1280], ['light', 375], ['dark', 375]]) {
  test(`${scheme}, ${width} wide: the playground has no serious problem`, need, async () => {
    const { page, close } = await openPlay({ scheme, width, bypassCSP: true });
    await page.locator('.finding').first().waitFor();
    for (const fold of await page.locator('.panel:not([open]) > summary').all()) await fold.click();
    assert.deepEqual(await seriousProblems(page), []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'no sideways scrolling');
    await close();
  });
}
