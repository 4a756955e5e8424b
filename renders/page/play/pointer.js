// The user's hand in the picture: a click is a point to aim at, a drag that starts on the body is a push. Everything
// else turns the view, as in the report. Works the same where the picture is drawn without WebGL.
import { Plane, Raycaster, Vector2, Vector3 } from 'three';

const kClickReach_px = 5;
const kFarthest_m = 40;

// The joint whose mesh this is.
function jointOf(object) {
  for (let at = object; at; at = at.parent) if (at.userData.of) return at;
  return null;
}

function rayThrough({ camera, x, y }) {
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2(x, y), camera);
  return ray;
}

export class PointerTool {
  // calls: enabled(), aim(point), push({joint, point, impulse}), pushing(text or ''), picked(joint, point),
  // strength(): N s for a metre of drag; surface(): whether a click means what is seen there
  constructor(stage, calls) {
    Object.assign(this, { stage, calls, drag: null, press: null });
    const { element } = stage;
    // Before the controls of the view, which listen on the canvas itself.
    element.addEventListener('pointerdown', (event) => this.down(event), true);
    element.addEventListener('pointermove', (event) => this.move(event), true);
    element.addEventListener('pointerup', (event) => this.up(event), true);
    element.addEventListener('pointercancel', () => this.cancel(), true);
  }

  touches(event) {
    return event.target === this.stage.drawing?.canvas && event.button <= 0 && this.calls.enabled();
  }

  // The nearest joint under the place, with the point that was met.
  hit(place) {
    const meshes = place.pane.figure.meshes().filter((mesh) => !mesh.userData.extra);
    const [met] = rayThrough(place).intersectObjects(meshes, false);
    const joint = met ? jointOf(met.object) : null;
    return joint ? { joint, point: met.point, distance: met.distance } : null;
  }

  down(event) {
    if (!this.touches(event)) return;
    const place = this.stage.at(event.clientX, event.clientY);
    if (!place) return;
    this.press = { x: event.clientX, y: event.clientY, place };
    const met = this.hit(place);
    if (!met) return;
    event.stopPropagation();
    event.preventDefault();
    this.stage.drawing.canvas.focus({ preventScroll: true });
    this.stage.element.setPointerCapture(event.pointerId);
    const local = met.joint.worldToLocal(met.point.clone());
    this.drag = { ...met, local, place, force: new Vector3() };
    this.escape = (key) => { if (key.key === 'Escape') { key.preventDefault(); this.cancel(); } };
    document.addEventListener('keydown', this.escape, true);
  }

  // Returns the drag in the plane that faces the viewer and goes through the grasped point.
  pulled(event) {
    const { drag } = this;
    const from = drag.joint.localToWorld(drag.local.clone());
    const box = this.stage.drawing.canvas.getBoundingClientRect();
    const { pane } = drag.place;
    const width = box.width / this.stage.panes.length;
    const left = box.left + this.stage.panes.indexOf(pane) * width;
    const camera = this.stage.cameraOf(pane, width / box.height);
    const ray = rayThrough({
      camera, x: 2 * (event.clientX - left) / width - 1, y: 1 - 2 * (event.clientY - box.top) / box.height,
    });
    const facing = new Plane().setFromNormalAndCoplanarPoint(camera.getWorldDirection(new Vector3()), from);
    const to = ray.ray.intersectPlane(facing, new Vector3());
    return { from, way: to ? to.sub(from) : drag.force.clone() };
  }

  move(event) {
    if (!this.drag) return;
    event.stopPropagation();
    const { from, way } = this.pulled(event);
    this.drag.force = way;
    this.drag.place.pane.push.show(from, way);
    const impulse = (way.length() * this.calls.strength()).toFixed(1);
    this.calls.pushing(`${impulse} N s on ${this.drag.joint.userData.of.name}`);
    this.stage.invalidate();
  }

  isClick(event) {
    return this.press && Math.hypot(event.clientX - this.press.x, event.clientY - this.press.y) <= kClickReach_px;
  }

  up(event) {
    const { drag, press } = this;
    const click = this.isClick(event);
    this.cancel();
    if (drag && click) this.calls.picked(drag.joint.userData.of, drag.local.toArray());
    else if (drag) {
      event.stopPropagation();
      const impulse = drag.force.clone().multiplyScalar(this.calls.strength());
      this.calls.push({ joint: drag.joint.userData.of, point: drag.local.toArray(), impulse: impulse.toArray() });
    } else if (press && click) {
      const point = this.pointAt(press.place);
      if (point) this.calls.aim(point.toArray());
    }
  }

  // Ends without doing anything.
  cancel() {
    this.press = null;
    if (!this.drag) return;
    document.removeEventListener('keydown', this.escape, true);
    this.drag.place.pane.push.hide();
    this.drag = null;
    this.calls.pushing('');
    this.stage.invalidate();
  }

  // Obstacle or ground; before the sky, or if the user wants it so, at the distance of the character.
  pointAt(place) {
    const { pane, camera } = place;
    const ray = rayThrough(place);
    const [met] = ray.intersectObjects([pane.ground, ...pane.obstacles.children], false);
    if (this.calls.surface() && met && met.point.distanceTo(pane.middle) < kFarthest_m) return met.point;
    const facing = new Plane().setFromNormalAndCoplanarPoint(camera.getWorldDirection(new Vector3()), pane.middle);
    return ray.ray.intersectPlane(facing, new Vector3());
  }
}
