// The things that the tests share: options, a browser, pages from a disk or from a server, and what a page did wrong.
import { spawnSync } from 'node:child_process';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { cpSync, existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join, normalize, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import vm from 'node:vm';

export const options = JSON.parse(process.env.CONTORT_PAGE_TEST ?? '{}');
const require = createRequire(join(resolve(options.modules ?? 'node_modules'), 'x.js'));
const axePath = () => require.resolve('axe-core/axe.min.js');
export const validator = () => require('gltf-validator');
export const openApiValidator = async () =>
  (await import(pathToFileURL(require.resolve('@seriousme/openapi-schema-validator')).href)).Validator;

const kCommon = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];
const kSoftwareGl = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const kNoGl = ['--disable-gpu', '--disable-software-rasterizer', '--disable-3d-apis'];

const browsers = new Map();

export async function browser(withGl = true) {
  if (!browsers.has(withGl)) {
    const { chromium } = require('playwright-core');
    browsers.set(withGl, await chromium.launch({
      executablePath: options.chromium, args: [...kCommon, ...(withGl ? kSoftwareGl : kNoGl)],
    }));
  }
  return browsers.get(withGl);
}

// ---- where reports come from

const kTypes = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.png': 'image/png', '.webp': 'image/webp',
  '.json': 'application/json',
};

const servers = new Map();

async function serve(folder) {
  if (servers.has(folder)) return servers.get(folder).url;
  const server = createServer((request, answer) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname)).replace(/^[/\\]+/, '');
    const file = join(folder, path || 'index.html');
    if (!file.startsWith(folder) || !existsSync(file)) { answer.writeHead(404).end(); return; }
    const type = kTypes[extname(file)] ?? 'application/octet-stream';
    answer.writeHead(200, { 'content-type': type }).end(readFileSync(file));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const url = `http://127.0.0.1:${server.address().port}/`;
  servers.set(folder, { server, url });
  return url;
}

// way: 'file' or 'http'
export async function urlOf(way, folder, file = 'index.html') {
  return way === 'file' ? pathToFileURL(join(folder, file)).href : `${await serve(folder)}${file}`;
}

const temporary = [];

// A copy of the report that a test may damage.
export function copyOf(folder) {
  const copy = mkdtempSync(join(tmpdir(), 'report_'));
  temporary.push(copy);
  cpSync(folder, copy, { recursive: true });
  return copy;
}

export async function closeAll() {
  for (const one of browsers.values()) await one.close();
  for (const { server } of servers.values()) { server.closeAllConnections(); server.close(); }
  for (const folder of temporary) rmSync(folder, { recursive: true, force: true });
}

// ---- cases of a report

// The first bucket of each card comes first: later ones of a card may be folded away.
export function readCases(folder) {
  const found = new Map();
  for (const name of readdirSync(join(folder, 'cases')).filter((file) => file.endsWith('.js')).sort())
    vm.runInNewContext(readFileSync(join(folder, 'cases', name), 'utf8'),
      { contortCase: (key, data) => found.set(key, data) });
  const cards = readFileSync(join(folder, 'index.html'), 'utf8').split("class='card").slice(1);
  const firsts = cards.map((card) => card.match(/data-case='([^']+)'/)?.[1]).filter((key) => found.has(key));
  return new Map([...new Set([...firsts, ...found.keys()])].map((key) => [key, found.get(key)]));
}

// Key of the first case for which `fits` is true; undefined where there is none.
export function findCase(cases, fits) {
  for (const [key, data] of cases) if (isWhole(data) && fits(data)) return key;
  return undefined;
}

function isWhole({ motions }) {
  return motions?.[0]?.frame_count > 10 && motions[0].glb.length > 4000 && motions[0].worst_frame > 0;
}

// ---- pages

// Opens a page and collects what it must not do. `more`: width, height, scheme, gl, bypassCSP, reducedMotion, javaScript.
export async function openPage(url, more = {}) {
  const context = await (await browser(more.gl ?? true)).newContext({
    viewport: { width: more.width ?? 1280, height: more.height ?? 900 }, colorScheme: more.scheme ?? 'light',
    bypassCSP: more.bypassCSP ?? false, javaScriptEnabled: more.javaScript ?? true, reducedMotion: more.reducedMotion ?? 'no-preference',
  });
  context.setDefaultTimeout(60_000);
  const page = await context.newPage();
  const wrong = [];
  const base = new URL('.', url).href;
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) wrong.push(message.text()); });
  page.on('pageerror', (error) => wrong.push(`uncaught: ${error.message}`));
  page.on('dialog', (dialog) => { wrong.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on('request', (request) => {
    if (!request.url().startsWith(base) && !/^(data|blob):/.test(request.url()))
      wrong.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  return { page, wrong, close: () => context.close() };
}

// Opens a case by its address and waits until the picture is there.
export async function openCase(url, key, more = {}) {
  const frame = more.frame === undefined ? '' : `&frame=${more.frame}`;
  const opened = await openPage(`${url}#case=${encodeURIComponent(key)}${frame}`, more);
  await ready(opened.page);
  return opened;
}

export async function ready(page, which = '0') {
  await page.waitForSelector(`.case[data-ready="${which}"]`);
  await settle(page);
}

// The problems that axe-core calls serious or worse. Cards are laid out first: axe-core takes those that are off the
// screen, which the browser has not laid out yet, to lie over each other.
export async function seriousProblems(page) {
  await page.addStyleTag({ content: '* { content-visibility: visible !important; }' });
  await page.addScriptTag({ path: axePath() });
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return violations.filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).slice(0, 3).join(' ')}`);
}

// Two pictures of the screen later everything that was asked for is drawn.
export async function settle(page) {
  await page.evaluate(() => new Promise((done) =>
    requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
}

// The drawn picture without the texts over it.
export async function picture(page) {
  await page.evaluate(() => {
    for (const over of document.querySelectorAll('.stage > :not(canvas)')) over.style.visibility = 'hidden';
  });
  await settle(page);
  const bytes = await page.locator('.stage-canvas').screenshot();
  await page.evaluate(() => {
    for (const over of document.querySelectorAll('.stage > :not(canvas)')) over.style.visibility = '';
  });
  return bytes;
}

export async function shownFrame(page) {
  return Number(await page.locator('.scrub').inputValue());
}

// Frame under the play head, from where it is on the screen.
export async function headFrame(page) {
  return page.evaluate(() => {
    const track = document.querySelector('.scrub-row .track').getBoundingClientRect();
    const head = document.querySelector('.playhead').getBoundingClientRect();
    const count = Number(document.querySelector('.scrub').max) + 1;
    return (head.left + head.width / 2 - track.left) / track.width * count - 0.5;
  });
}

// Place on the time axis inside `selector` for a frame, in the middle of its height.
export async function placeOf(page, selector, frame, row = 0.5) {
  return page.evaluate(([wanted, at, share]) => {
    const element = document.querySelector(wanted);
    element.scrollIntoView({ block: 'center' });
    const box = element.getBoundingClientRect();
    const track = document.querySelector('.scrub-row .track').getBoundingClientRect();
    const count = Number(document.querySelector('.scrub').max) + 1;
    return { x: track.left + (at + 0.5) / count * track.width, y: box.top + box.height * share };
  }, [selector, frame, row]);
}

export function chromiumVersion(path) {
  return spawnSync(path, ['--version'], { encoding: 'utf8' }).stdout?.trim() ?? '';
}
