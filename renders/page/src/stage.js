// The picture: one or two panes side by side, a camera that can be turned, drawn only when something changed.
import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { CanvasDrawing } from './draw_canvas.js';
import { webglDrawing } from './draw_webgl.js';
import { el, iconButton, textButton } from './dom.js';
import { Pane } from './pane.js';
import { onThemeChange, theme } from './theme.js';

const kNoWebgl = 'This browser cannot draw in 3-D (WebGL is switched off or missing), so the motion is drawn flat.';
const kDamaged = 'The 3-D model of this motion is missing or damaged and cannot be shown. The numbers below are complete.';
const kLost = 'The browser took the 3-D picture away. Close this case and open it again.';

const kFieldOfView = 32;  // Degrees, from top to bottom.
const kFarthest_m = 60;

// `load` makes a pane of a motion and the colours; `lost` is what is said when the browser takes the picture away;
// `asInStrip` is called when the reader wants to look from where the film strip does.
export class Stage {
  constructor({ load = Pane.load, lost: lostText = kLost, asInStrip } = {}) {
    this.load = load;
    this.asInStrip = asInStrip;
    this.drawing = webglDrawing() ?? new CanvasDrawing();
    this.flat = this.drawing instanceof CanvasDrawing;
    this.drawing.lost = (lost) => { this.say(lost ? lostText : ''); this.invalidate(); };
    this.toggles = { ghost: true, colliders: false, xray: true, follow: true };
    this.panes = [];
    this.frames = [];
    this.camera = new PerspectiveCamera(kFieldOfView, 1, 0.02, 400);
    this.makeElement();
    this.makeControls();
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.element);
    this.stopTheme = onThemeChange(() => this.rebuild());
  }

  makeElement() {
    this.labels = el('div', { class: 'pane-labels' });
    this.sentence = el('p', { class: 'stage-sentence', role: 'status', text: this.flat ? kNoWebgl : '' });
    const turn = (angle) => () => this.turn(angle);
    const zoom = (factor) => () => this.zoom(factor);
    this.stripButton = textButton('As in strip', 'v', () => this.asInStrip(), { hidden: true });
    this.stripButton.title = 'Look from where the film strip does (key v)';
    const buttons = el('div', { class: 'view-buttons', role: 'group', 'aria-label': 'View' },
      iconButton('left', 'Turn left', '', turn(-Math.PI / 8)), iconButton('right', 'Turn right', '', turn(Math.PI / 8)),
      iconButton('plus', 'Nearer', '', zoom(0.8)), iconButton('minus', 'Farther', '', zoom(1.25)),
      this.stripButton, el('button', { type: 'button', text: 'Reset view', on: { click: () => this.resetView() } }));
    this.element = el('div', { class: 'stage' }, this.drawing.canvas, this.labels, buttons,
      el('p', { class: 'stage-scale', text: `Squares of the ground: 1 m${this.flat ? '' : ', thin lines 0.25 m'}` }));
    this.frame = el('div', {}, this.element, this.sentence);
    const { canvas } = this.drawing;
    canvas.className = 'stage-canvas';
    canvas.tabIndex = -1;
    canvas.setAttribute('role', 'img');
  }

  makeControls() {
    const { canvas } = this.drawing;
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.2;
    this.controls.maxDistance = kFarthest_m;
    // The wheel scrolls the page until the picture was clicked; a finger moving up or down scrolls it too.
    this.controls.enableZoom = false;
    this.focusHandler = (event) => { this.controls.enableZoom = event.type === 'focus'; };
    canvas.addEventListener('focus', this.focusHandler);
    canvas.addEventListener('blur', this.focusHandler);
    this.pressHandler = () => canvas.focus({ preventScroll: true });
    canvas.addEventListener('pointerdown', this.pressHandler);
    canvas.style.touchAction = 'pan-y';
    this.controls.addEventListener('change', () => this.invalidate());
  }

  // Shows these motions; keeps the way of looking if `keepView`.
  async setMotions(motions, keepView) {
    this.motions = motions;
    const ticket = this.ticket = {};
    let panes = [];
    try {
      panes = await Promise.all(motions.map((motion) => this.load(motion, theme())));
    } catch (error) {
      panes = [];
      this.error = error;
    }
    // Meanwhile closed, or another motion was chosen.
    if (this.ticket !== ticket) { panes.forEach((pane) => pane.dispose()); return false; }
    this.panes.forEach((pane) => pane.dispose());
    this.panes = panes;
    this.say(panes.length ? '' : kDamaged);
    panes.forEach((pane, i) => { pane.apply(this.toggles); pane.show(this.frames[i] ?? pane.startFrame()); });
    if (panes.length > 0) this.afterLoad(keepView);
    this.invalidate();
    return panes.length > 0;
  }

  afterLoad(keepView) {
    const [pane] = this.panes;
    if (!keepView || !this.way) this.resetView();
    else this.follow(pane.middle);
    this.resize();
  }

  // After a change of colours.
  rebuild() {
    if (this.motions) this.setMotions(this.motions, true);
  }

  say(text) {
    this.sentence.textContent = text || (this.flat ? kNoWebgl : '');
  }

  show(frames) {
    this.frames = frames;
    this.panes.forEach((pane, i) => pane.show(frames[i]));
    if (this.panes.length && this.toggles.follow) this.follow(this.panes[0].middle);
    this.invalidate();
  }

  // Fewer pixels, for a machine that is too slow to play all of them.
  setQuick(quick) {
    if (this.flat || this.drawing.quick === quick) return;
    this.drawing.quick = quick;
    this.resize();
  }

  describe(texts, labels) {
    this.drawing.canvas.setAttribute('aria-label', texts);
    // Side by side, each over its own pane.
    while (this.labels.children.length > labels.length) this.labels.lastChild.remove();
    labels.forEach((text, i) => {
      const place = this.labels.children[i] ??
        this.labels.appendChild(el('div', {}, el('p', { class: `pane-label pane-${i}` })));
      if (place.firstChild.textContent !== text) place.firstChild.textContent = text;
    });
  }

  set(name, on) {
    this.toggles[name] = on;
    this.panes.forEach((pane) => pane.apply(this.toggles));
    if (name === 'follow' && on && this.panes.length) this.follow(this.panes[0].middle);
    this.invalidate();
  }

  follow(middle) {
    const shift = middle.clone().sub(this.controls.target);
    if (!this.way || shift.lengthSq() === 0) return;
    // A picture that the reader moved sideways stays moved: only the way of the figure is added.
    const step = middle.clone().sub(this.followed ?? middle);
    this.followed = middle.clone();
    this.camera.position.add(step);
    this.controls.target.add(step);
    this.controls.update();
  }

  resetView() {
    const [pane] = this.panes;
    if (!pane) return;
    this.way = pane.direction();
    this.setLens(kFieldOfView, kFarthest_m);
    const aspect = Math.max(0.4, this.paneWidth() / Math.max(1, this.element.clientHeight));
    const half = Math.tan(this.camera.fov * Math.PI / 360);
    const room = this.element.clientWidth < 620 ? 1.35 : 1.08;  // On a phone texts and buttons cover a part.
    const distance = room * pane.radius / Math.min(half, half * aspect);
    this.controls.target.copy(pane.middle).add(pane.offset);
    this.followed = pane.middle.clone();
    this.camera.position.copy(this.controls.target).addScaledVector(this.way, distance);
    this.controls.update();
    this.invalidate();
  }

  setLens(degrees, farthest) {
    this.camera.fov = degrees;
    this.controls.maxDistance = Math.max(kFarthest_m, farthest);
  }

  // Looks from the camera of a film strip's tile (strip_view.js). A narrower picture shows all of the tile, smaller.
  lookAs({ eye, target, tangent, aspect }) {
    const [pane] = this.panes;
    if (!pane) return;
    const here = this.paneWidth() / Math.max(1, this.element.clientHeight);
    const half = tangent * Math.max(1, aspect / here);
    this.setLens(Math.atan(half) * 360 / Math.PI, eye.distanceTo(target));
    this.way = eye.clone().sub(target).normalize();
    this.followed = pane.middle.clone();
    this.controls.target.copy(target);
    this.camera.position.copy(eye);
    this.controls.update();
    this.invalidate();
  }

  turn(angle) {
    const { target } = this.controls;
    const offset = this.camera.position.clone().sub(target).applyAxisAngle(new Vector3(0, 1, 0), angle);
    this.camera.position.copy(target).add(offset);
    this.controls.update();
    this.invalidate();
  }

  zoom(factor) {
    const { target } = this.controls;
    this.camera.position.sub(target).multiplyScalar(factor).add(target);
    this.controls.update();
    this.invalidate();
  }

  paneWidth() {
    return this.element.clientWidth / Math.max(1, this.panes.length);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.drawing.resize(width, height);
    this.invalidate();
  }

  invalidate() {
    if (this.waiting || !this.drawing) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = 0; this.draw(); });
  }

  draw() {
    const height = this.element.clientHeight;
    const width = this.paneWidth();
    if (!this.panes.length || width === 0 || height === 0) return;
    const views = this.panes.map((pane, i) =>
      ({ pane, camera: this.cameraOf(pane, width / height), x: i * width, width }));
    this.drawing.draw(views, height);
  }

  // The data for picking at a place on the screen: the pane, its camera, and the place as three.js's rays want it. Null
  // outside.
  at(clientX, clientY) {
    const box = this.drawing.canvas.getBoundingClientRect();
    const width = box.width / Math.max(1, this.panes.length);
    const i = Math.floor((clientX - box.left) / width);
    const pane = this.panes[i];
    if (!pane || clientY < box.top || clientY > box.bottom) return null;
    const x = (clientX - box.left - i * width) / width;
    const y = (clientY - box.top) / box.height;
    return { pane, camera: this.cameraOf(pane, width / box.height), x: 2 * x - 1, y: 1 - 2 * y };
  }

  // The second pane is seen from the same side, around its own figure.
  cameraOf(pane, aspect) {
    const camera = this.camera;
    const shift = pane.middle.clone().sub(this.panes[0].middle);
    const own = camera.clone();
    own.aspect = aspect;
    own.position.add(shift);
    own.updateProjectionMatrix();
    own.updateMatrixWorld(true);
    return own;
  }

  dispose() {
    this.ticket = null;
    cancelAnimationFrame(this.waiting);
    this.stopTheme();
    this.sizes.disconnect();
    this.controls.dispose();
    const { canvas } = this.drawing;
    canvas.removeEventListener('focus', this.focusHandler);
    canvas.removeEventListener('blur', this.focusHandler);
    canvas.removeEventListener('pointerdown', this.pressHandler);
    this.panes.forEach((pane) => pane.dispose());
    this.panes = [];
    this.drawing.release();
    this.drawing = null;
  }
}
