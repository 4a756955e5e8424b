// The marks of a failure: its parts, in red and seen through other parts; colliders; the ghost.
import {
  GreaterDepth, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, SphereGeometry,
} from 'three';
import { shapeMesh } from './shapes.js';

// Draws the mesh a second time, only where something is in front of it.
function throughOthers(mesh, colour) {
  const shine = new Mesh(mesh.geometry, new MeshBasicMaterial({
    color: colour, transparent: true, opacity: 0.4, depthFunc: GreaterDepth, depthWrite: false,
  }));
  shine.renderOrder = 5;
  shine.userData.extra = true;  // Not a part of the character.
  return shine;
}

function jointDot(colour) {
  const dot = new Mesh(new SphereGeometry(0.03, 14, 10), new MeshBasicMaterial({ color: colour, depthTest: false }));
  dot.renderOrder = 6;
  return dot;
}

// Returns {objects, through}: what is highlighted, and the extra meshes that shine through.
export function highlightJoints(figure, names, colours) {
  const objects = [];
  const through = [];
  const red = new MeshLambertMaterial({ color: colours.red, emissive: colours.red, emissiveIntensity: 0.25 });
  for (const name of names) {
    const joint = figure.joints.get(name);
    if (!joint) continue;
    joint.userData.marked = true;
    const owner = (object) => (object.userData.joint !== undefined ? object : owner(object.parent));
    const meshes = figure.meshesOf(joint);
    for (const mesh of meshes) {
      if (mesh.material === red) continue;  // Stands in for two joints.
      mesh.material = red;
      owner(mesh).userData.marked = true;
      objects.push(mesh);
      through.push(throughOthers(mesh, colours.red));
      mesh.add(through.at(-1));
    }
    if (meshes.length > 0) continue;
    const dot = jointDot(colours.red);
    dot.userData.extra = true;
    joint.add(dot);
    objects.push(dot);
  }
  return { objects, through };
}

function solidMaterial(colour, opacity) {
  // Many colliders lie exactly on the drawn shape; the offset keeps them from flickering.
  return new MeshLambertMaterial({
    color: colour, transparent: true, opacity, depthWrite: false, polygonOffset: true,
    polygonOffsetFactor: -2, polygonOffsetUnits: -2,
  });
}

// All colliders, each a child of its joint. The two solids of a collision are red and orange.
// Returns {all, marked, through}; those of `marked` are seen also when the others are switched off.
export function addColliders(figure, colliders, solids, colours) {
  const all = [];
  const marked = [];
  const through = [];
  const plain = solidMaterial(colours.collider, 0.3);
  const looks = [colours.red, colours.orange].map((colour) => solidMaterial(colour, 0.55));
  for (const shape of colliders) {
    const joint = figure.joints.get(shape.joint);
    const solid = solids.findIndex((names) => names.includes(shape.name));
    const mesh = joint ? shapeMesh(shape, solid < 0 ? plain : looks[solid % 2]) : null;
    if (!mesh) continue;
    mesh.renderOrder = 2;
    mesh.userData.extra = true;
    mesh.userData.solid = solid;
    joint.add(mesh);
    (solid < 0 ? all : marked).push(mesh);
    if (solid < 0) continue;
    through.push(throughOthers(mesh, solid % 2 ? colours.orange : colours.red));
    mesh.add(through.at(-1));
  }
  return { all, marked, through };
}

export function makeGhost(figure, colours) {
  // A little farther away than it is: where both are in one place, the character is seen, not a mixture.
  const grey = new MeshLambertMaterial({
    color: colours.ghost, transparent: true, opacity: 0.42, polygonOffset: true, polygonOffsetFactor: 2,
    polygonOffsetUnits: 8,
  });
  for (const mesh of figure.meshes()) {
    mesh.material = grey;
    mesh.castShadow = false;
    mesh.renderOrder = 1;
  }
  const group = new Group();
  group.add(figure.root);
  return group;
}
