// Models by Khronos's validator: what contort writes, and what a report holds, opens in any viewer.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gunzipSync } from 'node:zlib';
import { options, readCases, validator } from './support.mjs';

const project = resolve(dirname(fileURLToPath(import.meta.url)), '..', '..');
const squat = join(project, 'docs', 'experiments', 'squat');
const examples = ['reach_hand', 'rifle_two_sequences', 'swapped_parts', 'slope_reverse_legs', 'quadruped_stairs'];
const modes = ['human', 'mech', 'quadruped'].flatMap((name) => ['tracking', 'dynamic'].map((mode) => (
  { format: 'contort.spec/1', character: { name }, hold_frames: 20, dynamics: { mode } })));

async function assertValid(bytes, name) {
  const { issues } = await validator().validateBytes(new Uint8Array(bytes));
  assert.deepEqual({ errors: issues.numErrors, warnings: issues.numWarnings }, { errors: 0, warnings: 0 },
    `${name}: ${JSON.stringify(issues.messages.slice(0, 3))}`);
}

test('the validator finds faults', async () => {
  await assert.rejects(assertValid(Buffer.from('{"asset":{"version":"2.0"},"scene":3}'), 'a scene that is not there'));
});

test('every character and mode makes a valid .glb', { skip: options.contort ? false : 'no --contort' }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'model_'));
  try {
    const specs = examples.map((name) => join(project, 'docs', 'examples', `${name}.json`));
    specs.push(join(squat, 'd_blow.json'));
    modes.forEach((spec, i) => {
      specs.push(join(folder, `${i}.json`));
      writeFileSync(specs.at(-1), JSON.stringify(spec));
    });
    for (const spec of specs) {
      execFileSync(options.contort, ['--library', join(squat, 'actions'), 'generate', spec, '-o', join(folder, 'x.glb')],
        { stdio: 'ignore' });
      await assertValid(readFileSync(join(folder, 'x.glb')), spec);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

test('the models of a report are valid', async () => {
  let count = 0;
  for (const [key, { motions = [] }] of readCases(options.report))
    for (const [i, motion] of motions.entries()) {
      let bytes = null;
      try {
        bytes = gunzipSync(Buffer.from(motion.glb, 'base64'));
      } catch { /* Made-up reports have damaged ones, too. */ }
      if (!bytes) continue;
      await assertValid(bytes, `${key} ${i}`);
      ++count;
    }
  assert.ok(count > 0);
});
