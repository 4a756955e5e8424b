// Lets Contort test an animation generator that runs in Node (18 or newer). Copy this file next to your code, give
// `serve` a manifest (docs/reference/guests.md has all its fields) and a function that fills one pose for each frame.
// CommonJS modules load it with `const { serve } = await import('./contort_guest.mjs')`.
import net from 'node:net';
import process from 'node:process';

// Throw this when a request is outside what your generator can do. Contort does not count it as a fault.
export class Refused extends Error {}

// The pose of one frame. It begins as the rest pose. `fill` writes it into the reply.
export class Pose {
  constructor(joints) {
    this.index = new Map(joints.map((joint, i) => [joint.name, i]));
    this.rest = joints.map((joint) => joint.rotation ?? [0, 0, 0, 1]);
    this.root = joints[0].position ?? [0, 0, 0];
    this.rotations = this.rest.slice();
  }

  // Sets the quaternion [x, y, z, w] of a joint against its parent.
  set(joint, rotation) {
    this.rotations[this.at(joint)] = rotation;
  }

  // Turns a joint by an angle about an axis of its own frame, starting from its rest rotation.
  turn(joint, axis, angleDeg) {
    const i = this.at(joint);
    this.rotations[i] = multiply(this.rest[i], quaternion(axis, angleDeg));
  }

  at(joint) {
    const i = this.index.get(joint);
    if (i === undefined) throw new Error(`there is no joint '${joint}'`);
    return i;
  }
}

// One motion that Contort asks for: all fields of the request, and `uses`, the timeline with an end for each use.
export class Request {
  constructor(fields, joints) {
    Object.assign(this, fields);
    this.joints = joints;
    this.uses = fields.timeline.map((use) => ({ ...use, end_s: use.start_s + use.duration_s }));
  }

  // A new rest pose of the character.
  rest() {
    return new Pose(this.joints);
  }

  // The share of a use that is over at a time: 0 before and at its start, 1 at its end and after it.
  progress(use, timeS) {
    return timeS >= use.end_s ? 1 : Math.max(0, (timeS - use.start_s) / use.duration_s);
  }
}

// The quaternion [x, y, z, w] that turns by an angle about an axis, which need not have length 1.
export function quaternion(axis, angleDeg) {
  const half = (angleDeg * Math.PI) / 360;
  const scale = Math.sin(half) / Math.hypot(...axis);
  return [axis[0] * scale, axis[1] * scale, axis[2] * scale, Math.cos(half)];
}

// The product of two quaternions [x, y, z, w]: first b, then a.
export function multiply([ax, ay, az, aw], [bx, by, bz, bw]) {
  return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

// Answers requests until Contort closes the connection. `motion(request)` returns, or resolves to, a function of a time
// in seconds and the number of the frame. That function returns a Pose, or an array of numbers: a row of the reply as
// it is. An engine has its state in the closure of `motion`, so that each request begins afresh. With `tcp` it connects
// to the port in CONTORT_PORT, for programs that cannot use their standard streams.
export async function serve(manifest, motion, tcp = false) {
  const { source, write } = tcp ? await connect() : standardStreams();
  for await (const line of lines(source)) {
    const message = JSON.parse(line);
    if (message.op === 'hello') {
      const token = tcp ? { token: process.env.CONTORT_TOKEN } : {};
      await write(Buffer.from(JSON.stringify({ contort: 1, ...manifest, ...token }) + '\n'));
    } else if (message.op === 'generate') {
      await write(await answer(message, manifest, motion));
    }
  }
}

async function answer(message, manifest, motion) {
  const { id } = message;
  try {
    const joints = manifest.characters.find((character) => character.name === message.character).joints;
    const rows = await render(new Request(message, joints), motion, manifest.frames === 'f32');
    return Buffer.concat([Buffer.from(JSON.stringify({ id, bytes: rows.length }) + '\n'), rows]);
  } catch (error) {
    const reply = error instanceof Refused ? { id, error: 'refused', text: error.message }
      : { id, error: 'failed', text: String(error?.stack ?? error).slice(0, 2000) };
    return Buffer.from(JSON.stringify(reply) + '\n');
  }
}

async function render(request, motion, single) {
  const width = 3 + 4 * request.joints.length;
  const rows = new (single ? Float32Array : Float64Array)(width * request.frames);
  const poseAt = await motion(request);
  for (let frame = 0; frame < request.frames; ++frame) {
    const pose = poseAt(frame / request.rate_hz, frame);
    rows.set(pose instanceof Pose ? [...pose.root, ...pose.rotations.flat()] : pose, frame * width);
  }
  return Buffer.from(rows.buffer);
}

async function* lines(source) {
  let rest = '';
  for await (const chunk of source.setEncoding('utf8')) {
    const parts = (rest + chunk).split('\n');
    rest = parts.pop();
    yield* parts;
  }
}

async function connect() {
  const socket = net.connect({ port: Number(process.env.CONTORT_PORT), host: '127.0.0.1', noDelay: true });
  await new Promise((resolve, reject) => socket.once('connect', resolve).once('error', reject));
  return { source: socket, write: writer(socket, socket.write) };
}

// The two ends of the connection. All that the generator prints from now on goes to standard error.
function standardStreams() {
  const write = writer(process.stdout, process.stdout.write);
  process.stdout.write = process.stderr.write.bind(process.stderr);
  return { source: process.stdin, write };
}

function writer(stream, write) {
  return (bytes) => new Promise((resolve, reject) => {
    write.call(stream, bytes, (error) => (error ? reject(error) : resolve()));
  });
}
