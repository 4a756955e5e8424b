// The cameras of the film strip's tiles (contort.strip/1 in docs/reference/report.md), so that the moving picture can
// be seen from the same place.
import { Vector3 } from 'three';
import { Damaged } from './case_data.js';

const finite = (value) => typeof value === 'number' && Number.isFinite(value);
const vector = (value) =>
  (Array.isArray(value) && value.length === 3 && value.every(finite) ? new Vector3(...value) : null);

function readTile(tile) {
  const eye = vector(tile?.eye);
  const target = vector(tile?.target);
  const [, , width, height] = Array.isArray(tile?.box) ? tile.box : [];
  const shape = width > 0 && height > 0 ? width / height : 4 / 3;
  const usable = eye && target && eye.distanceTo(target) > 1e-3 && tile.tan_half_height > 0 && tile.tan_half_height < 10;
  return usable ? { frame: Number(tile.frame) || 0, eye, target, tangent: tile.tan_half_height, aspect: shape } : null;
}

export function readStrip(data) {
  const tiles = data?.format === 'contort.strip/1' && Array.isArray(data.tiles) ? data.tiles.map(readTile).filter(Boolean) : [];
  if (tiles.length === 0) throw new Damaged('The file that says from where the film strip is seen is damaged.');
  return tiles;
}

// The tile of this frame, or else of the one that is nearest to it.
export function nearestTile(tiles, frame) {
  return tiles.reduce((best, tile) => (Math.abs(tile.frame - frame) < Math.abs(best.frame - frame) ? tile : best));
}
