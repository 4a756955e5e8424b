// CCDIKSolver on a crane of two equal booms that turn about one axis. The booms may turn freely: their limits are a
// full turn wide, wherever it begins. Each point of the plane that is near enough can therefore be reached.
import { quaternion } from '../javascript/contort_guest.mjs';

const LENGTH = 0.5, BOX = 0.65;  // The corner of the box is 0.92 from the base, and the booms together reach 1.

const boom = (name, parent, y, restDeg) =>
  ({ name, parent, position: [0, y, 0], rotation: quaternion([0, 0, 1], restDeg) });

export const craneJoints = [{ name: 'base', slot: 'crane', type: 'fixed', position: [0, 0, 0] },
  boom('lower', 'base', 0, 20), boom('upper', 'lower', LENGTH, -60),
  { name: 'hook', parent: 'upper', position: [0, LENGTH, 0] }];

export const craneAction = { name: 'reach', slots: ['crane'], layer: 'ik', effect: 'cut', duration_s: [0.5, 1],
  help: 'The hook goes to a target and stays there.',
  params: {
    target: { type: 'vec3', low: [-BOX, -BOX, 0], high: [BOX, BOX, 0], default: [0.3, 0.5, 0],
      special: [[0, LENGTH, 0], [0, 0, 0], [0, -BOX, 0]] },
    limits: { type: 'choice', choices: ['none', 'lower', 'upper', 'both'] },
    middle_deg: { type: 'number', low: -180, high: 180, special: [-90, 90],
      help: 'Middle of the range of the limits.' } },
  goal: { param: 'target', tip: 'hook', within: 0.02 } };

export function startCrane(THREE, request) {
  const names = craneJoints.map(({ name }) => name);
  const bones = craneJoints.map(({ name, position, rotation }) => {
    const bone = new THREE.Bone();
    bone.name = name;
    bone.position.fromArray(position);
    if (rotation) bone.quaternion.fromArray(rotation);
    return bone;
  });
  craneJoints.forEach(({ parent }, i) => parent && bones[names.indexOf(parent)].add(bones[i]));
  const target = new THREE.Bone();
  const mesh = new THREE.SkinnedMesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial());
  mesh.add(bones[0], target);
  mesh.bind(new THREE.Skeleton([...bones, target]));
  let solver = null, next = 0;
  return (timeS, frame) => {
    for (; next < request.uses.length && request.uses[next].start_frame <= frame; ++next) {
      const { params } = request.uses[next];
      target.position.fromArray(params.target);
      solver = new THREE.CCDIKSolver(mesh, [chain(THREE, params)]);
    }
    mesh.updateMatrixWorld(true);
    solver?.update();
    return [...craneJoints[0].position, ...bones.flatMap(({ quaternion: q }) => [q.x, q.y, q.z, q.w])];
  };
}

function chain(THREE, { limits, middle_deg: middle }) {
  const ends = [middle - 180, middle + 180].map((deg) => new THREE.Vector3(0, 0, THREE.MathUtils.degToRad(deg)));
  const link = (name, index) => (limits === name || limits === 'both'
    ? { index, rotationMin: ends[0], rotationMax: ends[1] } : { index });
  return { target: 4, effector: 3, links: [link('upper', 2), link('lower', 1)], iteration: 100 };
}
