// Loads PlayCanvas in the version that CONTORT_PLAYCANVAS names (see find_package.mjs), without a page: the engine asks
// for a window while it is loaded, and an application needs graphics. The anim component needs neither.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { findPackage } from '../javascript/find_package.mjs';

export async function loadPlayCanvas() {
  const { folder, version } = findPackage('playcanvas', 'CONTORT_PLAYCANVAS');
  globalThis.window ??= globalThis;
  for (const name of ['Element', 'HTMLElement', 'HTMLCanvasElement']) globalThis[name] ??= class {};
  globalThis.navigator ??= { userAgent: '', maxTouchPoints: 0 };
  globalThis.document ??= { createElement: () => ({ getContext: () => null, style: {} }), addEventListener: () => {} };
  const file = ['playcanvas.mjs', 'playcanvas.js'].map((name) => path.join(folder, 'build', name)).find(fs.existsSync);
  const pc = file.endsWith('.mjs') ? await import(pathToFileURL(file).href) : createRequire(import.meta.url)(file);
  return { pc, version };
}

// An entity with an anim component, and the system that lets its time go by.
export function makeEntity(pc, name) {
  const systems = new pc.EventHandler();
  const root = new pc.GraphNode('scene');
  const app = { systems, assets: { get: () => null }, root, _entityIndex: {}, _enableList: [] };
  systems.anim = new pc.AnimComponentSystem(app);
  root._enabledInHierarchy = true;  // An application does the same with its root.
  const entity = new pc.Entity(name, app);
  root.addChild(entity);
  entity.addComponent('anim', { activate: true });
  return { entity, update: (seconds) => systems.anim.onAnimationUpdate(seconds) };
}
