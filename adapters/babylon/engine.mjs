// Loads @babylonjs/core in the version that CONTORT_BABYLON names (see find_package.mjs), from 4.2 on, and makes its
// clock stand still, so that the adapter alone decides how much time goes by from frame to frame.
import { register } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { findPackage } from '../javascript/find_package.mjs';

export const clock = { ms: 1e6 };

export async function loadBabylon() {
  const { folder, version, module } = findPackage('@babylonjs/core', 'CONTORT_BABYLON');
  const data = pathToFileURL(folder + path.sep).href;
  if (!module) register('../javascript/loose_modules.mjs', { parentURL: import.meta.url, data });
  const load = (file) => import(pathToFileURL(path.join(folder, file)).href);
  const BABYLON = Object.assign({}, ...(await Promise.all(PARTS.map(load))));
  Date.now = () => clock.ms;
  BABYLON.Logger.LogLevels = 0;
  return { BABYLON, version };
}

// The modules that the adapter needs; the whole engine would take seconds to load.
const PARTS = ['Engines/nullEngine.js', 'scene.js', 'Animations/index.js', 'Bones/index.js', 'Meshes/mesh.js',
  'Meshes/transformNode.js', 'Maths/math.js', 'Misc/logger.js'];
