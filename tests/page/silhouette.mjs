// Figures in pictures: where they are, and how much two of them have in common.
import { readFileSync, writeFileSync } from 'node:fs';
import { gunzipSync, gzipSync } from 'node:zlib';

// Runs in a page. Both pictures are brought to one size; a pixel is of the figure where it is warmer, more colourful or
// darker than ground, sky and shadow are. Strips are paler than the viewer's pictures, so they say what is pale. Lines of
// the ground are thinner than any limb and go with the opening. Gives the share of figure pixels of either picture that
// both have.
async function overlapInPage([first, second]) {
  const wide = 320;
  const high = Math.round(wide * first.box[3] / first.box[2]);
  const each = (call) => Array.from({ length: wide * high }, (_, i) => call(i % wide, Math.floor(i / wide)));
  // 1 where some (`grow`) or all pixels around are 1.
  const spread = (mask, grow) => each((x, y) => {
    for (let dy = -1; dy <= 1; ++dy)
      for (let dx = -1; dx <= 1; ++dx) {
        const inside = x + dx >= 0 && x + dx < wide && y + dy >= 0 && y + dy < high;
        if ((inside ? mask[(y + dy) * wide + x + dx] : false) === grow) return grow;
      }
    return !grow;
  });
  const maskOf = async ({ url, box: [x, y, width, height], pale }) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = new OffscreenCanvas(wide, high);
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, x, y, width, height, 0, 0, wide, high);
    const { data } = context.getImageData(0, 0, wide, high);
    const raw = each((column, row) => {
      const [r, g, b] = data.subarray(4 * (row * wide + column));
      const most = Math.max(r, g, b);
      const colour = most - Math.min(r, g, b);
      return r - b > 8 || colour > 48 || most < 140 || (pale && colour >= 17 && most < 180);
    });
    const closed = spread(spread(raw, true), false);
    return spread(spread(closed, false), true);
  };
  const [one, other] = [await maskOf(first), await maskOf(second)];
  let both = 0;
  let any = 0;
  for (let i = 0; i < one.length; ++i) { both += one[i] && other[i] ? 1 : 0; any += one[i] || other[i] ? 1 : 0; }
  const share = (mask) => mask.filter(Boolean).length / mask.length;
  return { overlap: both / Math.max(1, any), shares: [share(one), share(other)] };
}

// `pictures`: two of {bytes, box: [x, y, width, height], pale}; PNG.
export function overlap(page, pictures) {
  return page.evaluate(overlapInPage, pictures.map(({ bytes, box, pale }) =>
    ({ url: `data:image/png;base64,${bytes.toString('base64')}`, box, pale })));
}

// The part of a picture of this size that a tile with this shape fills when both have the same height.
export function middleOf(width, height, aspect) {
  const wide = Math.min(width, height * aspect);
  const high = wide / aspect;
  return [(width - wide) / 2, (height - high) / 2, wide, high];
}

const times = ([ax, ay, az, aw], [bx, by, bz, bw]) => [
  aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
  aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];

// The .glb (a Buffer) with one joint turned by `turn` (a quaternion) in every key.
function turned(glb, joint, turn) {
  const jsonBytes = glb.readUInt32LE(12);
  const model = JSON.parse(glb.subarray(20, 20 + jsonBytes).toString('utf8'));
  const binary = glb.subarray(20 + jsonBytes + 8);
  const node = model.nodes.findIndex(({ name }) => name === joint);
  for (const { channels, samplers } of model.animations)
    for (const { target, sampler } of channels.filter(({ target: { node: of, path } }) => of === node && path === 'rotation')) {
      const { bufferView, byteOffset = 0, count } = model.accessors[samplers[sampler].output];
      const start = (model.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
      for (let key = 0; key < count; ++key) {
        const at = start + 16 * key;
        const old = [0, 4, 8, 12].map((i) => binary.readFloatLE(at + i));
        times(old, turn).forEach((value, i) => binary.writeFloatLE(value, at + 4 * i));
      }
      return glb;
    }
  throw new Error(`no rotation of ${joint}`);
}

// In the file of a case, turns a joint of its first motion.
export function turnJoint(file, data, joint, turn) {
  const [first, ...others] = data.motions;
  const glb = gzipSync(turned(gunzipSync(Buffer.from(first.glb, 'base64')), joint, turn)).toString('base64');
  const changed = { ...data, motions: [{ ...first, glb }, ...others] };
  writeFileSync(file, `contortCase(${JSON.stringify(data.key)}, ${JSON.stringify(changed)});\n`);
}

// Names of the joints of the case's first motion that are animated.
export function animatedJoints(data) {
  const glb = gunzipSync(Buffer.from(data.motions[0].glb, 'base64'));
  const model = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString('utf8'));
  return model.animations.flatMap(({ channels }) => channels.filter(({ target }) => target.path === 'rotation')
    .map(({ target }) => model.nodes[target.node].name));
}

export const bytesOf = (file) => readFileSync(file);
