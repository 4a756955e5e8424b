// Spheres, capsules, boxes and hulls of a case's data as three.js objects.
import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, Float32BufferAttribute, Mesh, Quaternion, SphereGeometry, Vector3,
} from 'three';
import { ConvexGeometry } from 'three/addons/geometries/ConvexGeometry.js';

const kUp = new Vector3(0, 1, 0);

const isPoint = (p) => Array.isArray(p) && p.length === 3 && p.every(Number.isFinite);
const pointOf = (p) => (isPoint(p) ? new Vector3(...p) : new Vector3());
const radiusOf = (shape) => (shape.radius > 0 ? shape.radius : 0.005);

function capsule(shape, material) {
  const a = pointOf(shape.a);
  const along = pointOf(shape.b).sub(a);
  const mesh = new Mesh(new CapsuleGeometry(radiusOf(shape), along.length(), 6, 14), material);
  mesh.position.copy(a).addScaledVector(along, 0.5);
  if (along.length() > 1e-9) mesh.quaternion.setFromUnitVectors(kUp, along.normalize());
  return mesh;
}

function box(shape, material) {
  const half = pointOf(shape.half);
  const mesh = new Mesh(new BoxGeometry(2 * half.x, 2 * half.y, 2 * half.z), material);
  mesh.position.copy(pointOf(shape.center));
  if (Array.isArray(shape.rotation) && shape.rotation.length === 4)
    mesh.quaternion.copy(new Quaternion(...shape.rotation).normalize());
  return mesh;
}

function sphere(shape, material) {
  const mesh = new Mesh(new SphereGeometry(radiusOf(shape), 18, 12), material);
  mesh.position.copy(pointOf(shape.center));
  return mesh;
}

function hull(shape, material) {
  const points = (Array.isArray(shape.points) ? shape.points : []).filter(isPoint).map(pointOf);
  if (points.length < 4) return null;
  let geometry;
  try {
    geometry = new ConvexGeometry(points);
  } catch {  // Points on one plane have no hull: show the points' own triangles.
    geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(points.flatMap((p) => p.toArray()), 3));
  }
  return new Mesh(geometry, material);
}

const kMakers = { sphere, capsule, box, hull };

// Null where the shape is not known.
export function shapeMesh(shape, material) {
  const make = Object.hasOwn(kMakers, shape.shape) ? kMakers[shape.shape] : null;
  return make ? make(shape, material) : null;
}
