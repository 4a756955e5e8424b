// Drawing without WebGL: the same scenes as lines on a plain canvas.
import { Vector3, WireframeGeometry } from 'three';

const kGridReach = 5;

const place = (object) => object.getWorldPosition(new Vector3());

// Corners of the convex hull, around (monotone chain).
function convexOutline(points) {
  const sorted = [...points].sort((a, b) => a.x - b.x || a.y - b.y);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      const turnsBack = () => {
        const [a, b] = chain.slice(-2);
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
      };
      while (chain.length > 1 && turnsBack()) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

export class CanvasDrawing {
  constructor() {
    this.canvas = document.createElement('canvas');
    this.context = this.canvas.getContext('2d');
    this.wires = new WeakMap();
    this.corners = new WeakMap();
    this.lost = () => {};
  }

  resize(width, height) {
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
  }

  draw(views, height) {
    const c = this.context;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    for (const view of views) {
      c.save();
      c.beginPath();
      c.rect(view.x, 0, view.width, height);
      c.clip();
      this.drawView({ ...view, height });
      c.restore();
    }
  }

  drawView(view) {
    const { pane } = view;
    this.view = view;
    this.context.fillStyle = pane.colours.stage;
    this.context.fillRect(view.x, 0, view.width, view.height);
    this.drawGround(pane);
    for (const mesh of pane.obstacles.children) this.drawWire(mesh, pane.colours.obstacle, 1);
    if (pane.ghost?.visible) this.drawFigure(pane.ghostFigure, pane.colours.ghost, 0.4, null);
    this.drawFigure(pane.figure, pane.colours.bone, 1, pane.colours.red);
    for (const mesh of pane.colliders.all) if (mesh.visible) this.drawWire(mesh, pane.colours.collider, 0.5);
    for (const mesh of pane.colliders.marked)
      this.drawWire(mesh, mesh.userData.solid % 2 ? pane.colours.orange : pane.colours.red, 0.8);
    this.drawResponse(pane);
  }

  // Pixel of a point in the world, with the size of a metre there; null behind the camera.
  project(point) {
    const { camera, x, width, height } = this.view;
    const seen = point.clone().applyMatrix4(camera.matrixWorldInverse);
    if (seen.z > -camera.near) return null;
    const metre = camera.projectionMatrix.elements[5] * height / (2 * -seen.z);
    return { x: x + width / 2 + seen.x * metre, y: height / 2 - seen.y * metre, metre };
  }

  line(a, b) {
    const from = this.project(a);
    const to = this.project(b);
    if (!from || !to) return null;
    this.context.beginPath();
    this.context.moveTo(from.x, from.y);
    this.context.lineTo(to.x, to.y);
    this.context.stroke();
    return from;
  }

  drawGround(pane) {
    this.context.strokeStyle = pane.colours.line;
    this.context.lineWidth = 1;
    if (pane.motion.ground.positions) { this.drawWire(pane.ground, pane.colours.line, 1); return; }
    const y = pane.motion.ground.level;
    const cx = Math.round(pane.middle.x);
    const cz = Math.round(pane.middle.z);
    for (let i = -kGridReach; i <= kGridReach; ++i)
      for (let j = -kGridReach; j < kGridReach; ++j) {
        this.line(new Vector3(cx + i, y, cz + j), new Vector3(cx + i, y, cz + j + 1));
        this.line(new Vector3(cx + j, y, cz + i), new Vector3(cx + j + 1, y, cz + i));
      }
  }

  drawWire(mesh, colour, opacity) {
    if (!this.wires.has(mesh)) this.wires.set(mesh, new WireframeGeometry(mesh.geometry).getAttribute('position'));
    const ends = this.wires.get(mesh);
    this.context.strokeStyle = colour;
    this.context.globalAlpha = opacity;
    this.context.lineWidth = 1;
    for (let i = 0; i + 1 < ends.count; i += 2)
      this.line(mesh.localToWorld(new Vector3().fromBufferAttribute(ends, i)),
        mesh.localToWorld(new Vector3().fromBufferAttribute(ends, i + 1)));
    this.context.globalAlpha = 1;
  }

  // Each part as the outline of its corners, filled, the farther ones first. What is highlighted comes last, so nothing
  // hides it. Joints are joined by thin lines.
  drawFigure(figure, colour, opacity, red) {
    const c = this.context;
    const parts = figure.list.map((joint) => ({
      joint, marked: Boolean(red && joint.userData.marked), far: this.distance(joint),
      corners: this.cornersOf(figure, joint),
    }));
    parts.sort((a, b) => a.marked - b.marked || b.far - a.far);
    c.lineJoin = 'round';
    for (const { joint, corners, marked } of parts) {
      c.globalAlpha = opacity * (marked ? 0.85 : 1);
      this.fillOutline(corners.map((corner) => this.project(joint.localToWorld(corner.clone()))).filter(Boolean),
        marked ? red : colour);
      c.strokeStyle = marked ? red : colour;
      c.lineWidth = marked ? 4 : 2;
      for (const below of joint.children) if (below.userData.joint !== undefined) this.line(place(joint), place(below));
    }
    c.globalAlpha = 1;
  }

  distance(joint) {
    return this.view.camera.position.distanceTo(place(joint));
  }

  // Corners of what moves with the joint itself, in its frame. Thinned: the outline of a hundred tells enough.
  cornersOf(figure, joint) {
    if (this.corners.has(joint)) return this.corners.get(joint);
    const all = [];
    if (figure.hasMesh(joint)) {
      for (const mesh of figure.meshesOf(joint)) {
        const positions = mesh.geometry.getAttribute('position');
        const stride = Math.max(1, Math.floor(positions.count / 100));
        for (let i = 0; i < positions.count; i += stride)
          all.push(joint.worldToLocal(mesh.localToWorld(new Vector3().fromBufferAttribute(positions, i))));
      }
    }
    this.corners.set(joint, all);
    return all;
  }

  fillOutline(points, colour) {
    const outline = convexOutline(points);
    if (outline.length < 3) return;
    const c = this.context;
    c.beginPath();
    for (const { x, y } of outline) c.lineTo(x, y);
    c.closePath();
    c.fillStyle = colour;
    c.fill();
    c.strokeStyle = this.view.pane.colours.stage;
    c.lineWidth = 1;
    c.stroke();
  }

  drawResponse(pane) {
    const c = this.context;
    for (const { object } of [...pane.response.arrows, ...(pane.pushes ?? [])]) {
      if (!object.visible) continue;
      c.strokeStyle = pane.colours.arrow;
      c.lineWidth = 4;
      this.line(object.localToWorld(new Vector3(0, -0.6, 0)), object.localToWorld(new Vector3()));
      const tip = this.project(object.localToWorld(new Vector3()));
      if (tip) this.dot(tip, 6, pane.colours.arrow);
    }
    const { disc } = pane.response;
    const at = disc.visible ? this.project(disc.getWorldPosition(new Vector3())) : null;
    if (at) this.dot(at, 6, `#${disc.userData.material.color.getHexString()}`);
    for (const { object, colour } of pane.dots) {
      const middle = this.project(object.getWorldPosition(new Vector3()));
      if (middle) this.dot(middle, 7, colour);
    }
  }

  dot(at, radius, colour) {
    this.context.fillStyle = colour;
    this.context.beginPath();
    this.context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    this.context.fill();
  }

  release() {
    this.canvas.remove();
  }
}
