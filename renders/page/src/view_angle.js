// Chooses the side from which the failing parts are not hidden, and a pair is seen side by side.
import { Raycaster, Vector3 } from 'three';

const kProbes = 16;
const kHeight = 0.22;  // The direction's vertical part: a little from above.

function direction(azimuth) {
  return new Vector3(Math.sin(azimuth), kHeight, Math.cos(azimuth)).normalize();
}

function seenShare(points, from, blockers, ray) {
  let seen = 0;
  for (const point of points) {
    const way = from.clone().sub(point);
    ray.set(point, way.clone().normalize());
    ray.far = way.length();
    seen += ray.intersectObjects(blockers, false).length === 0 ? 1 : 0;
  }
  return seen / points.length;
}

function middleOf(object) {
  object.geometry.computeBoundingBox();
  return object.localToWorld(object.geometry.boundingBox.getCenter(new Vector3()));
}

// Direction from the figure to the camera. `marked`: highlighted meshes; `blockers`: the other meshes.
// `solids`: meshes of the two solids of a collision, or two empty arrays.
export function bestDirection({ middle, radius, marked, blockers, solids }) {
  if (marked.length === 0) return direction(0.7);
  const points = marked.map(middleOf);
  const aim = points.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(points.length);
  const side = aim.clone().sub(middle).setY(0);
  const pair = solids.map((meshes) => meshes.map(middleOf)).filter((middles) => middles.length > 0)
    .map((middles) => middles.reduce((sum, point) => sum.add(point), new Vector3()).divideScalar(middles.length));
  const between = pair.length === 2 ? pair[1].clone().sub(pair[0]).normalize() : null;
  const ray = new Raycaster();
  let best = null;
  for (let i = 0; i < kProbes; ++i) {
    const way = direction(2 * Math.PI * i / kProbes);
    const from = middle.clone().addScaledVector(way, 4 * radius);
    let score = seenShare(points, from, blockers, ray);
    score += 0.6 * way.dot(side) / Math.max(0.15 * radius, side.length());
    score -= between ? 0.5 * Math.abs(way.dot(between)) : 0;
    score += 0.15 * way.z;  // Rather from the front: people read faces.
    if (!best || score > best.score + 1e-9) best = { score, way };
  }
  return best.way;
}
