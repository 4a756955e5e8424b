// Writes a figure and its clips as a binary glTF file in memory, so that the engine reads them with its own loader, as
// it reads the files of real characters: with a skin, and with linear and cubic tracks.
import { keys, slopes } from '../javascript/figure.mjs';

const FLOAT = 5126, UNSIGNED_SHORT = 5123;

export function writeGlb(joints, clips) {
  const data = new Data();
  const index = new Map(joints.map(({ name }, i) => [name, i]));
  const nodes = joints.map(({ name, position, rotation }) => ({ name, translation: position, rotation,
    children: joints.flatMap(({ parent }, i) => (parent === name ? [i] : [])) }));
  for (const node of nodes) if (node.children.length === 0) delete node.children;
  const animations = clips.map((clip) => animation(clip, index, data));
  const mesh = nodes.push({ name: 'skin', mesh: 0, skin: 0 }) - 1;
  const corner = data.add([[0, 0, 0], [0.1, 0, 0], [0, 0.1, 0]], 'VEC3', FLOAT);
  const bones = data.add([[0, 0, 0, 0], [1, 0, 0, 0], [2, 0, 0, 0]], 'VEC4', UNSIGNED_SHORT);
  const weights = data.add([[1, 0, 0, 0], [1, 0, 0, 0], [1, 0, 0, 0]], 'VEC4', FLOAT);
  return pack({ asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0, mesh] }], nodes, animations,
    meshes: [{ primitives: [{ attributes: { POSITION: corner, JOINTS_0: bones, WEIGHTS_0: weights } }] }],
    skins: [{ joints: [...index.values()] }], accessors: data.accessors, bufferViews: data.views }, data.bytes());
}

function animation({ name, tracks }, index, data) {
  const samplers = tracks.map((track) => {
    const values = keys(track), slope = slopes(track), type = track.offsets ? 'VEC3' : 'VEC4';
    const rows = track.smooth ? values.flatMap((value, i) => [slope[i], value, slope[i]]) : values;
    return { input: data.add(track.times.map((time) => [time]), 'SCALAR', FLOAT), output: data.add(rows, type, FLOAT),
      interpolation: track.smooth ? 'CUBICSPLINE' : 'LINEAR' };
  });
  const channels = tracks.map((track, sampler) => ({ sampler,
    target: { node: index.get(track.joint), path: track.offsets ? 'translation' : 'rotation' } }));
  return { name, samplers, channels };
}

// The binary part of the file, and the accessors and views that describe it.
class Data {
  parts = [];
  length = 0;
  accessors = [];
  views = [];

  // Adds rows of numbers and returns the index of their accessor. All parts have a length that 4 divides.
  add(rows, type, componentType) {
    const array = componentType === FLOAT ? new Float32Array(rows.flat()) : new Uint16Array(rows.flat());
    this.views.push({ buffer: 0, byteOffset: this.length, byteLength: array.byteLength });
    this.parts.push(Buffer.from(array.buffer));
    this.length += array.byteLength;
    const column = (i) => rows.map((row) => row[i]);
    return this.accessors.push({ bufferView: this.views.length - 1, componentType, count: rows.length, type,
      min: rows[0].map((_, i) => Math.min(...column(i))), max: rows[0].map((_, i) => Math.max(...column(i))) }) - 1;
  }

  bytes() {
    return Buffer.concat(this.parts);
  }
}

function pack(json, bytes) {
  let text = JSON.stringify({ ...json, buffers: [{ byteLength: bytes.length }] });
  text = text.padEnd(Math.ceil(text.length / 4) * 4);
  const words = (...values) => Buffer.from(new Uint32Array(values).buffer);
  const file = Buffer.concat([words(0x46546c67, 2, 28 + text.length + bytes.length, text.length, 0x4e4f534a),
    Buffer.from(text), words(bytes.length, 0x004e4942), bytes]);
  return file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
}
