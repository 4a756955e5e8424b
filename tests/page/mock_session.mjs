// One session of the mock server: a rest model of contort's, and motion that is made up.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const kRate = 60;
const kAhead = 90;  // Frames that are sent before they are due.

export class Refusal extends Error {
  constructor(status, code, text, pointer = '') {
    super(text);
    Object.assign(this, { status, code, pointer });
  }
}

function restModel(contort, character, number) {
  const folder = mkdtempSync(join(tmpdir(), 'mock_'));
  try {
    const spec = join(folder, 'spec.json');
    const glb = join(folder, 'out.glb');
    writeFileSync(spec, JSON.stringify({ format: 'contort.spec/1', character, hold_frames: 1 }));
    try {
      execFileSync(contort, ['generate', spec, '-o', glb], { stdio: 'pipe' });
    } catch (error) {
      throw new Refusal(422, 'spec.build', String(error.stderr).trim().split('\n').at(-1), '/character');
    }
    const bytes = readFileSync(glb);
    const { nodes } = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
    const parents = new Map(nodes.flatMap(({ children = [] }, i) => children.map((child) => [child, i])));
    const joints = nodes.map(({ name }, i) => ({
      name, local_name: name.split('/').at(-1), parent: parents.get(i) ?? -1,
      slot: name.includes('/') ? name.split('/')[0] : 'waist',
    }));
    return {
      rest: nodes.map((node) => [...(node.translation ?? [0, 0, 0]), ...(node.rotation ?? [0, 0, 0, 1])]),
      answer: {
        model: number, joints, glb: bytes.toString('base64'), ground: { level: 0 }, obstacles: [], attachments: [],
        colliders: joints.filter(({ name }) => /shoulder$/.test(name)).map(({ name }) =>
          ({ name, joint: name, shape: 'sphere', center: [0, 0, 0], radius: 0.12 })),
        aims: [...joints.filter(({ name }) => /^arm.*shoulder$/.test(name)).map(({ slot }) =>
          ({ slot, action: 'aim', points: ['grip'] })), { slot: 'head', action: 'look_at', points: [] }],
      },
    };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

// Joints swing, the root goes ahead; every push lifts it for a while.
function frameOf(session, frame) {
  return session.model.rest.flatMap((rest, joint) => {
    const [x, y, z, ...turn] = rest;
    if (joint === 0) {
      const lift = session.pushes.reduce((sum, at) => sum + (frame > at ? 0.2 * Math.exp(-(frame - at) / 20) : 0), 0);
      return [x, y + lift, z + (session.spec.sequences?.length ? frame / 120 : 0), ...turn];
    }
    const half = 0.15 * Math.sin(frame / 20 + joint);
    return [x, y, z, Math.sin(half), 0, 0, Math.cos(half)];
  });
}

function marginsOf(session) {
  const dip = (worst) => Array.from({ length: session.frameCount }, (_, frame) =>
    0.5 - 0.7 * Math.exp(-(((frame - worst) / 12) ** 2)));
  const curve = (check, subject, worst) => ({ check, subject, unit: 'rad', scale: 0.1, margins: dip(worst) });
  const finding = ({ check, subject }, worst) => ({
    check, subject, unit: 'rad', worst_margin: -0.2, first_frame: worst - 5, worst_frame: worst, last_frame: worst + 5,
  });
  const curves = [curve('joint_range', session.name ?? 'arm_left/elbow', 30), curve('pop', 'head', 1e6),
    ...session.pushes.map((at) => curve('angular_velocity', 'torso', at + 20))];
  const findings = [finding(curves[0], 30), ...session.pushes.map((at, i) => finding(curves[2 + i], at + 20))];
  return { curves, findings };
}

// ---- sessions

export class MockSession {
  constructor(mock, id, { spec, modes }) {
    if (!mock.catalogue.characters.some(({ name }) => name === spec?.character?.name))
      throw new Refusal(422, 'character.unknown', `There is no character ${spec?.character?.name}.`, '/spec/character/name');
    Object.assign(this, { mock, id, spec: structuredClone(spec), modes: modes ?? ['kinematic'], take: 0, models: 0 });
    this.name = mock.subject;
    this.streams = new Set();
    this.begin();
    this.timer = setInterval(() => this.tick(), 50);
  }

  begin() {
    const model = restModel(this.mock.contort, this.spec.character, ++this.models);
    Object.assign(this, { model, frameCount: this.mock.frameCount, revision: 1, base: 0, since: 0, playing: false, pushes: [], sent: 0 });
    ++this.take;
    for (const stream of this.streams) this.send(stream);
  }

  frame() {
    const time = this.base + (this.playing ? (Date.now() - this.since) / 1000 * kRate : 0);
    return Math.min(this.frameCount - 1, Math.floor(time));
  }

  clock(playing, frame = this.frame()) {
    Object.assign(this, { playing, base: frame, since: Date.now() });
    this.tell('clock', { take: this.take, frame, playing });
  }

  state() {
    const { id, spec, take, revision, frameCount, playing, modes, model } = this;
    let at = 0;
    const queue = (spec.sequences ?? []).map((_, sequence) => ({ first_frame: at, last_frame: (at += 60) - 1, sequence }));
    return { session: id, spec, take, revision, frame: this.frame(), frame_count: frameCount, rate_hz: kRate, playing, modes,
      model: model.answer.model, findings: [], queue };
  }

  frames(mode, from, count) {
    return { ...this.common(mode), from, count, data: this.compact(from, count).toString('base64') };
  }

  compact(from, count) {
    return Buffer.from(Float32Array.from(Array.from({ length: count }, (_, i) => frameOf(this, from + i)).flat()).buffer);
  }

  bytes(wanted) {
    return this.compact(Number(wanted.get('from')), Number(wanted.get('count')));
  }

  common(mode) {
    return { take: this.take, revision: this.revision, mode };
  }

  // Everything that a terminal needs that has nothing yet.
  send(stream) {
    const { take, revision, modes } = this;
    const write = (kind, data) => stream.write(`event: ${kind}\ndata: ${JSON.stringify(data)}\n\n`);
    write('take', { take, revision, rate_hz: kRate, frame_count: this.frameCount, modes, model: this.model.answer.model });
    this.sent = Math.min(this.frameCount, this.frame() + kAhead);
    const from = this.frame();
    for (const mode of modes) {
      write('frames', this.frames(mode, from, this.sent - from));
      write('margins', { ...this.common(mode), ...marginsOf(this) });
      write('spans', { ...this.common(mode), spans: this.spans(), marks: this.pushes.map((frame) =>
        ({ frame, kind: 'impact', text: 'push', point: [0, 1, 0], impulse: [0, 0, 20] })) });
    }
    write('clock', { take, frame: this.frame(), playing: this.playing });
  }

  spans() {
    return this.state().queue.flatMap(({ first_frame: first, last_frame: last, sequence }) =>
      (this.spec.sequences[sequence].clips ?? []).flatMap((clip) => (clip.actions ?? []).map(({ action, slot }) =>
        ({ name: action, action, slot, sequence: String(sequence), clip: '', first_frame: first, last_frame: last }))));
  }

  tell(kind, data) {
    for (const stream of this.streams) stream.write(`event: ${kind}\ndata: ${JSON.stringify(data)}\n\n`);
  }

  changed() {
    ++this.revision;
    for (const mode of this.modes) {
      this.tell('frames', this.frames(mode, this.frame() + 1, kAhead));
      this.tell('margins', { ...this.common(mode), ...marginsOf(this) });
      this.tell('spans', { ...this.common(mode), spans: this.spans(), marks: [] });
    }
    this.sent = this.frame() + 1 + kAhead;
  }

  tick() {
    if (!this.playing) return;
    const frame = this.frame();
    const due = Math.min(this.frameCount, frame + kAhead);
    if (due > this.sent) {
      for (const mode of this.modes) this.tell('frames', this.frames(mode, this.sent, due - this.sent));
      this.sent = due;
    }
    if (Date.now() - (this.told ?? 0) > 1000) {
      this.told = Date.now();
      this.tell('clock', { take: this.take, frame, playing: true });
    }
    if (frame === this.frameCount - 1) { this.begin(); this.clock(true, 0); }
  }

  command(name, body) {
    this.mock.commands.push({ name, body });
    const act = {
      enqueue: () => { (this.spec.sequences ??= []).push(body.sequence); this.changed(); },
      interrupt: () => { (this.spec.sequences ??= []).push(body.sequence); this.changed(); },
      aim: () => this.changed(),
      push: () => { this.pushes.push(this.frame() + 1); this.changed(); },
      clock: () => this.clock(body.play ?? false, body.restart ? 0 : this.frame() + (body.step ?? 0)),
      change: () => this.change(body),
    }[name];
    if (!act) throw new Refusal(404, 'call.unknown', `There is no call ${name}.`);
    act();
    return this.state();
  }

  change({ character, environment, loads, modes }) {
    const before = structuredClone(this.spec);
    if (character) this.spec.character = character;
    if (environment) this.spec.environment = environment;
    if (loads) (this.spec.dynamics ??= {}).loads = loads;
    if (modes) this.modes = modes;
    this.spec.sequences = [];
    const { playing } = this;
    try {
      this.begin();
    } catch (error) {
      this.spec = before;
      throw error;
    }
    this.clock(playing, 0);
  }

  end() {
    clearInterval(this.timer);
    for (const stream of this.streams) stream.end();
  }
}
