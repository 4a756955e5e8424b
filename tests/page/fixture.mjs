// Makes reports for the browser tests: node fixture.mjs --contort BINARY --viewer DIR --out DIR
//
// OUT/report has cases of every kind, OUT/single.html one file with everything in it, OUT/large a page of 3,000 cards, most of
// them in files beside it.
// Motions are real ones, made by `contort generate` from docs/examples; margins are invented.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync, copyFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateSync, gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '..', '..');

// ---- pictures

function crc(bytes) {
  let c = ~0;
  for (const byte of bytes) {
    c ^= byte;
    for (let k = 0; k < 8; ++k) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  }
  return ~c >>> 0;
}

function chunk(kind, body) {
  const out = Buffer.alloc(12 + body.length);
  out.writeUInt32BE(body.length, 0);
  out.write(kind, 4, 'latin1');
  body.copy(out, 8);
  out.writeUInt32BE(crc(out.subarray(4, 8 + body.length)), 8 + body.length);
  return out;
}

// A plain grey picture in the shape of a film strip.
export function tinyPng(width = 129, height = 54) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head[8] = 8;
  const rows = Buffer.alloc((width + 1) * height, 70);
  for (let y = 0; y < height; ++y) rows[y * (width + 1)] = 0;
  return Buffer.concat([Buffer.from('89504e470d0a1a0a', 'hex'), chunk('IHDR', head), chunk('IDAT', deflateSync(rows)),
    chunk('IEND', Buffer.alloc(0))]);
}

// ---- motions

function generated(contort, work, name) {
  const out = join(work, `${name}.glb`);
  const spec = join(root, 'docs', 'examples', `${name}.json`);
  execFileSync(contort, ['generate', spec, '-o', out], { stdio: 'ignore' });
  execFileSync(contort, ['generate', spec, '-o', out.replace(/glb$/, 'json')], { stdio: 'ignore' });
  const numbers = JSON.parse(readFileSync(out.replace(/glb$/, 'json'), 'utf8'));
  return {
    spec: JSON.parse(readFileSync(spec, 'utf8')), glb: gzipSync(readFileSync(out)).toString('base64'),
    rate_hz: numbers.rate_hz, frame_count: numbers.frames.length,
  };
}

function spansOf(spec, frameCount) {
  return spec.sequences.flatMap((sequence, s) => sequence.clips.flatMap((clip, c) => clip.actions.map((action) => {
    const first = action.start_frame ?? 0;
    return {
      name: action.action, action: action.action, slot: action.slot ?? action.part ?? 'body', sequence: `${s + 1}`,
      clip: clip.name ?? `${c + 1}`, first_frame: first,
      last_frame: Math.min(frameCount - 1, first + (action.duration_frames ?? frameCount)),
    };
  })));
}

// Safe, then down to -1.4 scales around the worst frame.
function dip(frameCount, worst, depth, width) {
  return Array.from({ length: frameCount }, (_, frame) =>
    0.9 + 0.1 * Math.sin(frame / 5) - (0.9 + depth) * Math.exp(-(((frame - worst) / width) ** 2)));
}

function curves(failure, frameCount, worst) {
  const scaled = (values, scale) => values.map((value) => Number((value * scale).toPrecision(6)));
  const quiet = [['dof_limits', 'arm_left/elbow max', 'rad', 0.1], ['joint_range', 'torso/lumbar_flex', 'rad', 0.1],
    ['angular_velocity', 'arm_right/shoulder', 'rad/s', 4], ['foot_slide', 'foot_left', 'm', 0.02],
    ['ground_penetration', 'foot_right', 'm', 0.02], ['pop', 'head/neck_rot', 'rad', 0.1]];
  const others = quiet.map(([check, subject, unit, scale], i) => ({
    check, subject, unit, scale,
    margins: scaled(dip(frameCount, (worst + 9 * i) % frameCount, i === 0 ? 0.15 : -0.2 - 0.1 * i, 4 + 3 * i), scale)
      .map((value, frame) => (i === 3 && frame % 30 < 8 ? null : value)),
  }));
  return [{ ...failure, margins: scaled(dip(frameCount, worst, 1.4, Math.max(2, frameCount / 14)), failure.scale) }, ...others];
}

function motion(role, made, failure, share, more = {}) {
  const worst = Math.round((made.frame_count - 1) * share);
  const all = curves(failure, made.frame_count, worst);
  const violated = all[0].margins.map((value, frame) => (value < 0 ? frame : -1)).filter((frame) => frame >= 0);
  return {
    role, rate_hz: made.rate_hz, frame_count: made.frame_count,
    first_frame: violated[0], worst_frame: worst, last_frame: violated.at(-1),
    spec: made.spec, free_fields: [], glb: made.glb, ghost_glb: '', colliders: kBodies,
    highlight: { joints: [], colliders: [] }, ground: { level: 0 }, obstacles: [],
    spans: spansOf(made.spec, made.frame_count), marks: [], balance: [], curves: all, ...more,
  };
}

// Some solids of the human.
const kBodies = [
  { name: 'torso', joint: 'torso/lumbar_rot', shape: 'capsule', a: [0, 0.02, 0], b: [0, 0.3, 0], radius: 0.13 },
  { name: 'head', joint: 'head/neck_rot', shape: 'sphere', center: [0, 0.13, 0.01], radius: 0.12 },
  { name: 'upper_arm_left', joint: 'arm_left/shoulder', shape: 'capsule', a: [0, 0, 0], b: [0, -0.28, 0], radius: 0.055 },
  { name: 'fore_arm_left', joint: 'arm_left/elbow', shape: 'capsule', a: [0, 0, 0], b: [0, -0.26, 0], radius: 0.048 },
  { name: 'hip', joint: 'root', shape: 'box', center: [0, 0.02, 0], half: [0.17, 0.1, 0.11], rotation: [0, 0, 0, 1] },
  { name: 'foot_left', joint: 'foot_left/ankle_inv', shape: 'hull',
    points: [[-0.05, -0.08, -0.06], [0.05, -0.08, -0.06], [-0.05, -0.08, 0.2], [0.05, -0.08, 0.2], [0, 0.03, 0]] },
];

function stairs() {
  const positions = [];
  const indices = [];
  const quad = (corners) => {
    const first = positions.length / 3;
    positions.push(...corners.flat());
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  };
  const flat = (z0, z1, y) => quad([[-3, y, z0], [-3, y, z1], [3, y, z1], [3, y, z0]]);
  flat(-4, 0.8, 0);
  for (let i = 0; i < 6; ++i) {
    const z = 0.8 + 0.4 * i;
    quad([[-3, 0.14 * i, z], [-3, 0.14 * (i + 1), z], [3, 0.14 * (i + 1), z], [3, 0.14 * i, z]]);
    flat(z, i === 5 ? z + 6 : z + 0.4, 0.14 * (i + 1));
  }
  return { positions, indices };
}

// ---- cases

const kHostile = '"><script>window.hacked=1</script><img src=x onerror=window.hacked=1>\u202e';

function collision(made) {
  const failure = { check: 'self_collision', subject: 'fore_arm_left ~ torso', unit: 'm', scale: 0.02, resolution: 1e-6 };
  const highlight = { joints: [], colliders: [['fore_arm_left'], ['torso']] };
  const free = ['/character', '/sequences/0/clips/0/actions/0/blend_in_frames', '/sequences/0/clips/0/actions/0/params'];
  return { key: 'self_collision-0a1b2c3d', character: 'human', failure, motions: [
    motion('minimal', made.reach_hand, failure, 0.6, { highlight, free_fields: free,
      measured: '28 mm deep in each other, limit 0 mm',
      unmet: [{ action: 'reach', slot: 'arm_left', first_frame: 38, last_frame: 40, why: 'it is out of reach' }],
      not_judged: [{ check: 'joint_torque', title: 'Needs more effort than its strength', reason: 'the motion has no dynamics' }],
      obstacles: [{ shape: 'box', center: [0.9, 0.5, 0.6], half: [0.2, 0.5, 0.2], rotation: [0, 0, 0, 1] }] }),
    motion('original', made.walk_touch_wall, failure, 0.45, { highlight }),
    motion('worst', made.look_at_extend, failure, 0.5, { highlight })] };
}

function balance(made) {
  const failure = { check: 'balance', subject: 'whole body', unit: 'm', scale: 0.05 };
  const { frame_count: count } = made.hit_reaction;
  const balanceOf = (frame) => ({ zmp: [0.1 * Math.sin(frame / 9), 0, 0.05], margin: 0.1 - frame / 300 });
  return { key: 'balance-99aa00bb', character: 'human', failure, motions: [motion('minimal', made.hit_reaction, failure, 0.5, {
    ghost_glb: made.reach_hand.glb,
    marks: [{ frame: 12, kind: 'impact', text: 'blow on torso, 30 N s', point: [0.1, 1.3, 0.12], impulse: [-10, 2, -28] },
      { frame: 50, kind: 'event', text: 'fall' },
      { frame: Math.floor(0.6 * count), kind: 'impact', text: 'blow on arm_right/shoulder, 30 N s', point: [0, 1, 0], impulse: [0, 0, 9] }],
    balance: Array.from({ length: count }, (_, frame) => (frame < 3 ? null : balanceOf(frame))) })] };
}

function hostile(made) {
  const failure = { check: `dof_limits${kHostile}`, subject: kHostile, unit: kHostile, scale: 0.1 };
  const one = motion('minimal', made.pose_elbow, failure, 0.5, {
    highlight: { joints: [kHostile, 'arm_left/elbow', '__proto__'], colliders: [[kHostile]] },
    free_fields: ['/__proto__', '/character', 5],
    marks: [{ frame: 2, kind: kHostile, text: kHostile }],
  });
  one.spec = { ...one.spec, [kHostile]: kHostile };
  one.spans = [{ name: kHostile, slot: kHostile, sequence: kHostile, clip: kHostile, action: kHostile, first_frame: -5, last_frame: 99999 }];
  one.colliders = [{ name: kHostile, joint: kHostile, shape: 'constructor' }, { name: 'x', joint: 'root', shape: 'hull', points: [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]] }];
  return { key: 'dof_limits-0000dead', character: kHostile.replaceAll(' ', '_'), failure, motions: [one] };
}

function allCases(made) {
  const slide = { check: 'foot_slide', subject: 'foot_left/ankle_flex', unit: 'm', scale: 0.02 };
  const range = { check: 'joint_range', subject: 'arm_left/elbow max', unit: 'rad', scale: 0.1 };
  const single = motion('minimal', { ...made.pose_elbow, frame_count: 1 }, range, 0, { highlight: { joints: ['torso/lumbar_flex'], colliders: [] } });
  return [
    collision(made),
    { key: 'foot_slide-11223344', character: 'human', failure: slide, motions: [
      motion('minimal', made.walk_stairs, slide, 0.55, { ground: stairs(), highlight: { joints: ['foot_left/ankle_flex'], colliders: [] } })] },
    balance(made),
    hostile(made),
    { key: 'joint_range-55667788', character: 'human', failure: range, worst: null, motions: [single] },
    { key: 'model_damaged-00000001', character: 'human', failure: range, motions: [
      motion('minimal', { ...made.pose_elbow, glb: made.pose_elbow.glb.slice(0, 2000) }, range, 0.5)] },
  ];
}

const caseData = (one) => ({
  format: 'contort.report_case/1', key: one.key, check: one.failure.check, subject: one.failure.subject,
  title: 'Plain name', character: one.character,
  unit: one.failure.unit, worst_margin: one.worst === null ? null : Math.min(...one.motions[0].curves[0].margins),
  first_frame: one.motions[0].first_frame, worst_frame: one.motions[0].worst_frame, last_frame: one.motions[0].last_frame,
  motions: one.motions,
});

// ---- page

const html = (text) => String(text).replace(/[&<>"'\u202e]/g, (sign) => `&#${sign.codePointAt(0)};`);
const scriptJson = (value) => JSON.stringify(value).replaceAll('<', '\\u003c').replaceAll('\u2028', '\\u2028');
const kNonce = 'c0ffee0123456789';

const kPhases = ['interrupt', 'mid_clip', 'blend'];
const phaseOf = (one) => kPhases[one.key.length % 3];

function card(one, state, more = '') {
  const { check, subject } = one.failure;
  const parts = [...new Set(subject.split(/[ ~]+/).filter(Boolean).map((word) => word.split('/')[0]))].join(' ');
  return `<article tabindex='-1' class='card gating' data-check='${html(check.replaceAll(' ', '_'))}' data-state='${state}' data-character='${html(one.character)}' data-parts='${html(parts)}' data-phase='${phaseOf(one)}'>
<div class='head'>
<h3><span class='check'>${html(check)}</span> <span class='subject'>${html(subject)}</span></h3>
<p class='summary'><span class='chip state-${state}'>${state}<span class='unseen'> (fails the build)</span></span> <span>12 cases</span></p>
</div>
<section class='bucket' id='b-${html(one.key)}' data-case='${html(one.key)}'>
<div class='strip tile-5'><a href='strips/${one.strip ?? one.key}.png'><img src='strips/${one.strip ?? one.key}.png' loading='lazy' alt='Film strip: ${html(check)}' data-missing='picture missing'></a></div>
<dl class='facts'>
<div><dt>worst margin</dt><dd>-0.028 m (-28.0 mm)</dd></div>
<div><dt>bucket</dt><dd>${html(one.key)}</dd></div>
</dl>
<div class='command'><code>contort replay ${html(one.key)} &amp;&amp; echo &lt;done&gt;</code><button type='button' class='copy' aria-label='Copy the replay command'>Copy</button></div>
<button type='button' class='open'>Look closer</button>
</section>
${more}</article>
`;
}

function filterForm() {
  const select = (id, name) => `<label><span>${name}</span><select id='${id}'></select></label>\n`;
  return `<form class='filter' role='search'>
<label class='words'><span>Filter</span><input type='search' id='words' autocomplete='off' spellcheck='false' placeholder='elbow, state:new, walk'></label>
${select('check', 'Check')}${select('character', 'Character')}${select('part', 'Part')}${select('phase', 'Phase')}${select('state', 'State')}<output id='shown' aria-live='polite'></output>
</form>
`;
}

// As renders/causes_html.cpp writes it: the thumbnail is a tile of the film strip.
function causesTable(cases) {
  const row = (one, i) => `<tr><td class='picture' rowspan='2'><a class='thumb tile-5' href='#case=${html(one.key)}'><img src='strips/${one.key}.png' loading='lazy' width='320' height='216' alt='Worst frame: ${html(one.failure.check)}'></a></td><th scope='row'><span class='headline'><a href='#case=${html(one.key)}'>Something goes wrong with ${html(one.failure.subject)} during a long name of an action</a></span><span class='worst'>at worst 28 mm deep in each other, limit 0 mm</span></th><td class='novelty'><span class='chip${i ? '' : ' state-new'}'>${i ? 'known' : 'new'}</span></td><td class='severity'><b>high</b> <span class='dim'>12.3 of 100</span></td><td class='often'><b>25 %</b> <span class='dim'>250 of 1 000 cases</span></td><td class='who'>human, mech, quadruped</td></tr>
<tr class='unfold'><td colspan='5'><details><summary>1 <abbr title='One way to break a check'>failure</abbr>, how to see it</summary>
<p class='when'>human: Fails where the turn is fast.</p>
<ul class='members'>
<li><a href='#case=${html(one.key)}'>${html(one.failure.subject)}</a> <span class='dim'>Plain name; new</span></li>
</ul>
<div class='command'><code>contort replay ${html(one.key)}</code><button type='button' class='copy' aria-label='Copy the replay command'>Copy</button></div>
</details></td></tr>
`;
  return `<section id='causes'>
<h2>What is wrong</h2>
<table class='causes'>
<thead><tr><th scope='col'><span class='unseen'>Worst frame</span></th><th scope='col'>Cause</th><th scope='col'>New?</th><th scope='col'>Severity</th><th scope='col'>How often</th><th scope='col'>Characters</th></tr></thead>
<tbody>
${cases.map(row).join('')}</tbody>
</table>
</section>
`;
}

function page(cards, count, more = '', rows = { files: 0, note: '' }, causes = '') {
  const read = (name) => readFileSync(join(root, 'renders', 'page', name), 'utf8');
  return `<!doctype html>
<html lang='en'>
<head>
<meta charset='utf-8'>
<meta http-equiv='Content-Security-Policy' content="default-src 'none'; img-src 'self' file: data:; style-src 'nonce-${kNonce}'; script-src 'nonce-${kNonce}'; base-uri 'none'; form-action 'none'">
<meta name='viewport' content='width=device-width, initial-scale=1'>
<meta name='color-scheme' content='light dark'>
<meta name='referrer' content='no-referrer'>
<title>${count} new failures \u2013 fixture</title>
<link rel='icon' href='data:,'>
<style nonce='${kNonce}'>
${read('page.css')}</style>
<script nonce='${kNonce}'>
${read('rows.js')}${read('page.js')}</script>
</head>
<body>
<a class='skip' href='#failures'>Skip to the failures</a>
<header class='verdict bad'>
<div class='page'>
<p class='title'>fixture</p>
<h1>${count} new failures</h1>
<p class='detail'>In ${count} kinds of failure.</p>
<dl class='numbers'>
<div><dt>cases</dt><dd>1 000</dd></div>
</dl>
</div>
</header>
<main class='page'>
${causes}<section id='failures'${rows.files ? ` data-row-files='${rows.files}'` : ''}>
<h2>Failures</h2>
${filterForm()}${cards}${rows.note}<p class='none' id='no-match' hidden>Nothing matches the filter.</p>
</section>
</main>
<footer class='page'><p>Made by contort.<span class='keys'> Keys: <kbd>/</kbd> filter, <kbd>j</kbd> <kbd>k</kbd> next and previous failure, <kbd>Enter</kbd> look closer.</span></p></footer>
${more}</body>
</html>
`;
}

function writeReport(out, viewer, cases) {
  for (const folder of ['cases', 'strips', 'viewer']) mkdirSync(join(out, folder), { recursive: true });
  for (const name of ['viewer.js', 'viewer.css']) copyFileSync(join(viewer, name), join(out, 'viewer', name));
  for (const one of cases) {
    writeFileSync(join(out, 'strips', `${one.key}.png`), tinyPng());
    writeFileSync(join(out, 'cases', `${one.key}.js`), `contortCase(${scriptJson(one.key)}, ${scriptJson(caseData(one))});\n`);
  }
  const states = ['new', 'regressed', 'open'];
  const cards = cases.map((one, i) => card(one, states[i % 3])).join('');
  const rows = { files: 0, note: '' };
  writeFileSync(join(out, 'index.html'), page(cards, cases.length, '', rows, causesTable(cases.slice(0, 4))));
}

// Viewer and cases in the page itself.
function writeSingle(file, viewer, cases) {
  const read = (name) => readFileSync(join(viewer, name), 'utf8');
  const inline = `<style nonce='${kNonce}'>\n${read('viewer.css')}</style>\n<script nonce='${kNonce}'>\n` +
    `${read('viewer.js').replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--')}</script>\n` + cases.map((one) =>
    `<script type='application/json' id='case-${html(one.key)}'>${scriptJson(caseData(one))}</script>\n`).join('');
  writeFileSync(file, page(cases.map((one) => card(one, 'new')).join(''), cases.length, inline));
}

// The row that renders/report_rest.cpp writes for a card that the page has no room for.
const lateCard = (one, number, state) => ({
  card: number, check: one.failure.check, subject: one.failure.subject, character: one.character,
  parts: one.failure.subject.split('/')[0], phase: phaseOf(one), state, gating: true, count: '12 cases, 2 buckets',
  chips: [[state, true]], more: '1 more bucket',
  buckets: [one.key, `${one.key}0`].map((key) =>
    ({ key, text: 'worst -0.03 m at frame 3, 0.05 s; needs walk', open: true, command: `contort replay ${key}` })),
});

const kOnPage = 400;
const kPerFile = 500;

function writeLarge(out, viewer, cases, count) {
  for (const folder of ['strips', 'cases', 'viewer', 'rows']) mkdirSync(join(out, folder), { recursive: true });
  for (const name of ['viewer.js', 'viewer.css']) copyFileSync(join(viewer, name), join(out, 'viewer', name));
  const checks = ['self_collision', 'foot_slide', 'joint_range', 'pop', 'balance'];
  const parts = ['arm_left', 'arm_right', 'leg_left', 'leg_right', 'torso', 'head'];
  const many = Array.from({ length: count }, (_, i) => ({
    key: `${checks[i % 5]}-${(i * 2654435761 >>> 0).toString(16).padStart(8, '0')}`, character: ['human', 'mech', 'dog'][i % 3],
    failure: { check: checks[i % 5], subject: `${parts[i % 6]}/joint_${i}` },
  }));
  const states = ['new', 'open', 'fixed'];
  for (const one of many.slice(0, kOnPage)) writeFileSync(join(out, 'strips', `${one.key}.png`), tinyPng());
  for (const { key } of [many[0], many[count - 1]])
    writeFileSync(join(out, 'cases', `${key}.js`), `contortCase(${scriptJson(key)}, ${scriptJson(caseData({ ...cases[0], key }))});\n`);
  const late = many.slice(kOnPage).map((one, i) => lateCard(one, kOnPage + i, states[(kOnPage + i) % 3]));
  // The first card's buckets go on in the file, too.
  late.unshift({ card: 0, buckets: [{ key: 'late-0000', text: 'worst', open: false, command: '' }] });
  const files = Math.ceil(late.length / kPerFile);
  for (let i = 0; i < files; ++i)
    writeFileSync(join(out, 'rows', `part-${i + 1}.js`), `contortRows(${scriptJson(late.slice(i * kPerFile, (i + 1) * kPerFile))});\n`);
  const note = `<p class='rest' id='rest'>${late.length} more failures in <a href='more.html'>the plain list</a>.</p>\n`;
  const begun = "<details data-more='0'><summary>1 more bucket</summary>\n<p class='rest'>1 of them is elsewhere.</p>\n</details>\n";
  const cards = many.slice(0, kOnPage).map((one, i) => card(one, states[i % 3], i === 0 ? begun : ''));
  writeFileSync(join(out, 'more.html'), '<!doctype html>\n<title>more</title>\n');
  writeFileSync(join(out, 'index.html'), page(cards.join(''), count, '', { files, note }));
}

export function makeFixture({ contort, viewer, out }) {
  const work = join(out, 'motions');
  mkdirSync(work, { recursive: true });
  const names = ['reach_hand', 'walk_touch_wall', 'look_at_extend', 'walk_stairs', 'hit_reaction', 'pose_elbow'];
  const made = Object.fromEntries(names.map((name) => [name, generated(contort, work, name)]));
  const cases = allCases(made);
  writeReport(join(out, 'report'), viewer, cases);
  writeSingle(join(out, 'single.html'), viewer, cases.slice(0, 4));
  writeLarge(join(out, 'large'), viewer, cases, 3000);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const value = (name) => { const at = process.argv.indexOf(`--${name}`); return at > 0 ? process.argv[at + 1] : ''; };
  if (!value('contort') || !value('viewer') || !value('out')) {
    console.error('usage: node fixture.mjs --contort BINARY --viewer DIR --out DIR');
    process.exit(2);
  }
  makeFixture({ contort: resolve(value('contort')), viewer: resolve(value('viewer')), out: resolve(value('out')) });
}
