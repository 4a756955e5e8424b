// Loads three.js in the version that CONTORT_THREE names (see find_package.mjs), from 0.116 on, with the parts of its
// examples that move characters. Older versions have scripts that add to a global THREE, newer ones have modules.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { findPackage } from '../javascript/find_package.mjs';

const EXAMPLES = ['loaders/GLTFLoader.js', 'animation/CCDIKSolver.js', 'utils/SkeletonUtils.js'];

export async function loadThree() {
  const { folder, version, module } = findPackage('three', 'CONTORT_THREE');
  globalThis.self ??= globalThis;
  const THREE = module ? await modules(folder) : scripts(folder);
  return { THREE, version };
}

async function modules(folder) {
  const load = (...parts) => import(pathToFileURL(path.join(folder, ...parts)).href);
  const THREE = { ...(await load('build', 'three.module.js')) };
  for (const example of EXAMPLES) {
    if (!fs.existsSync(path.join(folder, 'examples', 'jsm', example))) continue;
    const part = await load('examples', 'jsm', example);
    if (example.endsWith('SkeletonUtils.js')) THREE.SkeletonUtils = part.SkeletonUtils ?? part;
    else Object.assign(THREE, part);
  }
  return THREE;
}

function scripts(folder) {
  const THREE = createRequire(import.meta.url)(path.join(folder, 'build', 'three.js'));
  for (const example of EXAMPLES) {
    const file = path.join(folder, 'examples', 'js', example);
    if (fs.existsSync(file)) new Function('THREE', fs.readFileSync(file, 'utf8'))(THREE);
  }
  return THREE;
}
