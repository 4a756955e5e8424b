// BoneIKController on an arm of two bones, and BoneLookController on an eye beside it. Every target in the box is
// within reach of the arm, so that the hand must arrive.
import { clock } from './engine.mjs';

const LENGTH = 0.5, BOX = 0.5;  // The corner of the box is 0.87 from the shoulder, and the arm reaches 1.

export const armJoints = [{ name: 'base', slot: 'arm', type: 'fixed' },
  { name: 'upper', parent: 'base', position: [0, 0, 0] },
  { name: 'lower', parent: 'upper', position: [0, LENGTH, 0] },
  { name: 'hand', parent: 'lower', position: [0, LENGTH, 0] },
  { name: 'eye', slot: 'eye', parent: 'base', position: [0.5, 0.5, 0] }];

const point = (preset, ...special) => ({ type: 'vec3', low: -BOX, high: BOX, default: preset, special });
const angle = { type: 'number', low: -180, high: 180, special: [-90, 90] };

export const armActions = [
  { name: 'reach', slots: ['arm'], layer: 'ik', effect: 'cut', duration_s: [0.2, 0.6],
    params: { target: point([0.2, 0.4, 0.3], [0, 0, 0], [0, LENGTH, 0]),
      pole: point([0, 0, BOX], [0, 0, 0], [0, LENGTH, 0]), pole_deg: angle },
    goal: { param: 'target', tip: 'hand', within: 0.01 } },
  { name: 'look', slots: ['eye'], layer: 'ik', effect: 'cut', duration_s: [0.2, 0.6],
    params: { target: point([0.2, 0.4, 0.3], [0.5, 0.5, 0]),
      limit_deg: { type: 'number', low: 0, high: 180, default: 180 } } }];

export function startArm(BABYLON, engine, request) {
  const { Bone, Matrix, Mesh, Scene, Skeleton, Vector3 } = BABYLON;
  const scene = new Scene(engine);
  scene.useRightHandedSystem = true;
  const mesh = new Mesh('arm', scene);
  const skeleton = mesh.skeleton = new Skeleton('arm', 'arm', scene);
  const bones = new Map();
  for (const { name, parent, position = [0, 0, 0] } of armJoints) {
    bones.set(name, new Bone(name, skeleton, bones.get(parent) ?? null, Matrix.Translation(...position)));
  }
  mesh.computeWorldMatrix(true);
  skeleton.computeAbsoluteTransforms(true);  // The controllers measure the lengths of bones when they are made.
  const controllers = new Map();
  const begin = {
    reach: ({ target, pole, pole_deg: poleDeg }) =>
      Object.assign(new BABYLON.BoneIKController(mesh, bones.get('lower'), { poleAngle: (poleDeg * Math.PI) / 180 }),
        { targetPosition: new Vector3(...target), poleTargetPosition: new Vector3(...pole), poleTargetBone: null }),
    look: ({ target, limit_deg: limit }) => {
      const most = (limit * Math.PI) / 180;
      return new BABYLON.BoneLookController(mesh, bones.get('eye'), new Vector3(...target),
        { minYaw: -most, maxYaw: most, minPitch: -most / 2, maxPitch: most / 2 });
    } };
  let next = 0;
  return (timeS, frame) => {
    for (; next < request.uses.length && request.uses[next].start_frame <= frame; ++next) {
      const { action, params } = request.uses[next];
      controllers.set(action, begin[action](params));
    }
    clock.ms += 1000 / request.rate_hz;
    skeleton.computeAbsoluteTransforms(true);
    for (const controller of controllers.values()) controller.update();
    return armRow(BABYLON, bones);
  };
}

function armRow({ Quaternion, Vector3 }, bones) {
  const row = [0, 0, 0], scale = new Vector3(), turned = new Quaternion(), moved = new Vector3();
  for (const bone of bones.values()) {
    bone.getLocalMatrix().decompose(scale, turned, moved);
    row.push(turned.x * scale.y, turned.y * scale.y, turned.z * scale.y, turned.w * scale.y);
  }
  return row;
}
