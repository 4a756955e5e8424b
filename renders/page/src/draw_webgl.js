// Drawing with WebGL. Browsers allow only some contexts per page, so there is one for all cases.
import { PCFShadowMap, WebGLRenderer } from 'three';

let shared = null;

// Null where the browser has no WebGL. The context is asked for here, because three.js would write errors about it.
export function webglDrawing() {
  if (shared) return shared;
  try {
    const canvas = document.createElement('canvas');
    const context = canvas.getContext('webgl2', { antialias: true, powerPreference: 'low-power' });
    if (!context) return null;
    shared = new WebglDrawing(canvas, context);
  } catch {
    shared = null;
  }
  return shared;
}

class WebglDrawing {
  constructor(canvas, context) {
    this.canvas = canvas;
    this.quick = false;
    this.renderer = new WebGLRenderer({ canvas, context, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.lost = () => {};
    canvas.addEventListener('webglcontextlost', (event) => { event.preventDefault(); this.lost(true); });
    canvas.addEventListener('webglcontextrestored', () => this.lost(false));
  }

  resize(width, height) {
    this.renderer.setPixelRatio(this.quick ? 0.5 : Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
  }

  // views: {pane, camera, x, width}, side by side
  draw(views, height) {
    this.renderer.setScissorTest(true);
    for (const { pane, camera, x, width } of views) {
      this.renderer.setViewport(x, 0, width, height);
      this.renderer.setScissor(x, 0, width, height);
      this.renderer.render(pane.scene, camera);
    }
  }

  release() {
    this.lost = () => {};
    this.quick = false;
    this.renderer.renderLists.dispose();
    this.canvas.remove();
  }
}
