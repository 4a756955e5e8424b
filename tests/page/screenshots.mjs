// Pictures of a report for its documentation: node screenshots.mjs FOLDER, with the options that run.mjs gives to tests.
import { spawn } from 'node:child_process';
import { statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { closeAll, findCase, openCase, openPage, options, readCases, urlOf } from './support.mjs';

const kMostBytes = 150_000;  // Whoever clones the project has them all.

// Browsers write WebP, and know how; the best quality that is small enough.
async function webp(page, png) {
  for (const quality of [0.92, 0.85, 0.75, 0.6, 0.45]) {
    const text = await page.evaluate(async ([url, wanted]) => {
      const image = new Image();
      image.src = url;
      await image.decode();
      const canvas = document.createElement('canvas');
      Object.assign(canvas, { width: image.width, height: image.height });
      canvas.getContext('2d').drawImage(image, 0, 0);
      return canvas.toDataURL('image/webp', wanted);
    }, [`data:image/png;base64,${png.toString('base64')}`, quality]);
    const bytes = Buffer.from(text.slice(text.indexOf(',') + 1), 'base64');
    if (bytes.length < kMostBytes) return bytes;
  }
  throw new Error('no quality makes this picture small enough');
}

const url = await urlOf('file', options.report);
const cases = readCases(options.report);
// The failure that people see first: two parts of a body in each other, or else any failure.
const key = findCase(cases, (data) => data.check === 'self_collision') ?? findCase(cases, () => true);

async function shoot(folder, name, opened) {
  await opened.page.waitForTimeout(600);
  const bytes = await webp(opened.page, await opened.page.screenshot());
  const file = join(folder, name);
  writeFileSync(file, bytes);
  console.log(`${file}: ${statSync(file).size} bytes`);
  await opened.close();
}

// The playground in the middle of something: a figure that was pushed while it walked, in two modes.
async function openPlayground(contort) {
  const server = spawn(contort, ['serve', '--port', '0'], { stdio: ['ignore', 'pipe', 'inherit'] });
  process.on('exit', () => server.kill());
  const base = await new Promise((done) => {
    server.stdout.on('data', (text) => { const found = /http:\S+\//.exec(text); if (found) done(found[0]); });
  });
  const opened = await openPage(`${base}play`, { width: 1400, height: 1060 });
  await opened.page.waitForSelector('.stage[data-ready]');
  const session = await opened.page.evaluate(() => window.contortPlay.session.id);
  const call = (path, body) => fetch(`${base}api/sessions/${session}${path}`,
    { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) });
  const walk = { action: 'walk', slot: 'waist', duration_frames: 200, params: { speed_m_s: 1.2 } };
  await call('/change', { modes: ['kinematic', 'dynamic'] });
  await call('/enqueue', { sequence: { clips: [{ actions: [walk] }] } });
  await call('/clock', { play: true });
  await opened.page.waitForTimeout(2500);
  await call('/push', { slot: 'torso', impulse_N_s: [400, 0, 50] });
  await opened.page.waitForTimeout(1500);
  const close = async () => { await opened.close(); server.kill(); };
  return { ...opened, close };
}

const folder = process.argv[2];
if (options.contort) await shoot(folder, 'playground.webp', await openPlayground(options.contort));
await shoot(folder, 'report_list.webp', await openPage(url, { width: 1200, height: 900 }));
await shoot(folder, 'report_case.webp', await openCase(url, key, { width: 1280, height: 1000 }));
await shoot(folder, 'report_dark.webp', await openCase(url, key, { width: 1280, height: 1000, scheme: 'dark' }));
await shoot(folder, 'report_phone.webp', await openPage(url, { width: 390, height: 844 }));
await closeAll();
