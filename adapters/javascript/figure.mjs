// A figure of twelve joints and its clips, which the adapters of engines share. All clips begin and end in the rest
// pose, so that each may start, loop and end without a jump. They differ as clips of real files do: in length, in the
// joints that they move and in their interpolation. They are asymmetric in time and have spans in which nothing moves.
import { multiply, quaternion } from './contort_guest.mjs';

const X = [1, 0, 0], Y = [0, 1, 0], Z = [0, 0, 1];

const joint = (name, parent, position, rotation = [0, 0, 0, 1]) => ({ name, parent, position, rotation });

export const joints = [
  joint('root', '', [0, 1, 0]),
  joint('hips', 'root', [0, 0, 0]),
  joint('spine', 'hips', [0, 0.15, 0], quaternion(X, 5)),
  joint('head', 'spine', [0, 0.45, 0], quaternion(X, -5)),
  joint('arm_l', 'spine', [0.2, 0.35, 0], quaternion(Z, -70)),
  joint('forearm_l', 'arm_l', [0.3, 0, 0]),
  joint('arm_r', 'spine', [-0.2, 0.35, 0], quaternion(Z, 70)),
  joint('forearm_r', 'arm_r', [-0.3, 0, 0]),
  joint('thigh_l', 'hips', [0.1, -0.05, 0]),
  joint('shin_l', 'thigh_l', [0, -0.45, 0]),
  joint('thigh_r', 'hips', [-0.1, -0.05, 0]),
  joint('shin_r', 'thigh_r', [0, -0.45, 0]),
];

// A track turns a joint from its rest pose by angles about an axis of its own frame; `move` shifts it instead.
const turn = (name, axis, times, anglesDeg, smooth = false) => ({ joint: name, axis, times, anglesDeg, smooth });
const move = (name, times, offsets, smooth = false) => ({ joint: name, times, offsets, smooth });

export const clips = [
  { name: 'walk', duration: 1.5, tracks: [
    turn('thigh_l', X, [0, 0.4, 0.75, 1.2, 1.5], [0, -25, 0, 15, 0]),
    turn('shin_l', X, [0, 0.4, 0.7, 1.5], [0, 30, 5, 0]),
    turn('thigh_r', X, [0, 0.35, 0.75, 1.3, 1.5], [0, 18, 0, -18, 0]),
    turn('shin_r', X, [0, 0.7, 1.1, 1.5], [0, 0, 30, 0]),
    turn('arm_l', Y, [0, 0.45, 1.1, 1.5], [0, 20, -18, 0]),
    turn('hips', Y, [0, 0.45, 1.5], [0, 10, 0]),
    move('root', [0, 0.3, 0.9, 1.5], [[0, 0, 0], [0, 0.03, 0], [0.02, -0.02, 0], [0, 0, 0]]) ] },
  { name: 'wave', duration: 1.8, tracks: [
    turn('arm_r', Z, [0, 0.6, 1.3, 1.8], [0, -40, -40, 0]),
    turn('forearm_r', Y, [0, 0.4, 0.9, 1.3, 1.8], [0, 25, -10, 30, 0]),
    turn('head', Y, [0, 0.6, 1.8], [0, 25, 0]) ] },
  { name: 'bow', duration: 1.6, tracks: [
    turn('spine', X, [0, 0.7, 1, 1.6], [0, 40, 35, 0], true),
    turn('head', X, [0, 0.6, 1.6], [0, 30, 0], true),
    turn('arm_l', X, [0, 0.5, 1, 1.6], [0, 30, 30, 0], true),
    turn('hips', Z, [0, 1.1, 1.6], [0, 15, 0], true),
    move('root', [0, 0.7, 1.6], [[0, 0, 0], [0, -0.04, 0], [0, 0, 0]], true) ] },
  { name: 'dip', duration: 1.2, tracks: [
    turn('thigh_l', X, [0, 0.4, 1.2], [0, -30, 0]),
    turn('thigh_r', X, [0, 0.4, 1.2], [0, -30, 0]),
    turn('shin_l', X, [0, 0.45, 1.2], [0, 40, 0]),
    turn('shin_r', X, [0, 0.45, 1.2], [0, 40, 0]),
    turn('spine', Y, [0, 0.3, 0.7, 1.2], [0, -20, 12, 0]),
    move('root', [0, 0.4, 1.2], [[0, 0, 0], [0, -0.05, 0], [0, 0, 0]]) ] },
];

// The values of a track's keys: quaternions against the parent, or positions.
export function keys(track) {
  const { position, rotation } = joints.find(({ name }) => name === track.joint);
  if (track.offsets) return track.offsets.map((offset) => offset.map((value, i) => value + position[i]));
  return track.anglesDeg.map((angle) => multiply(rotation, quaternion(track.axis, angle)));
}

// The slopes of a smooth track at its keys: those of the chord between the neighbours, and 0 at the ends.
export function slopes(track) {
  const values = keys(track);
  return values.map((value, i) => {
    if (i === 0 || i === values.length - 1) return value.map(() => 0);
    const seconds = track.times[i + 1] - track.times[i - 1];
    return value.map((_, k) => (values[i + 1][k] - values[i - 1][k]) / seconds);
  });
}

// The joints as a manifest lists them, with limits that follow from the clips. `use` says how the adapter plays them:
// `timeScale` is the greatest factor of a clip's own speed, `fadeS` the shortest fade, and `additive` whether one clip
// may be added to another, as the difference from any of its poses.
export function limitedJoints(use) {
  return joints.map((joint, i) => (i === 0 ? { ...joint, type: 'fixed' } : limited(joint, use)));
}

function limited(joint, { timeScale, fadeS, additive }) {
  const tracks = clips.flatMap((clip) => clip.tracks).filter((one) => one.joint === joint.name && one.anglesDeg);
  const angles = [0, ...tracks.flatMap((track) => track.anglesDeg)];
  const least = Math.min(...angles), most = Math.max(...angles), span = most - least;
  const layers = additive ? 2 : 1;
  const low = Math.floor(1.1 * (least - (layers - 1) * span)) - 1;
  const high = Math.ceil(1.1 * (most + (layers - 1) * span)) + 1;
  const speed = layers * (timeScale * Math.max(0, ...tracks.map(fastest)) + (2 * span) / fadeS) + 10;
  const oneAxis = new Set(tracks.map((track) => String(track.axis))).size === 1;
  const range = oneAxis ? { type: 'hinge', axis: tracks[0].axis, low_deg: low, high_deg: high }
    : { axis: Y, low_deg: -layers * span - 1, high_deg: layers * span + 1, swing_deg: layers * span + 1 };
  return { ...joint, ...range, max_speed_deg_s: Math.ceil(speed) };
}

// The greatest speed of a track in degrees per second. A smooth track is up to 1.6 times as fast as its chords.
function fastest({ anglesDeg, times, smooth }) {
  const speeds = anglesDeg.slice(1).map((angle, i) => Math.abs(angle - anglesDeg[i]) / (times[i + 1] - times[i]));
  return Math.max(...speeds) * (smooth ? 1.6 : 1);
}
