// One mode of a session as a scene: poses come from the server, frame by frame.
import { Vector3 } from 'three';
import { list, readGround } from '../src/case_data.js';
import { loadModel } from '../src/figure.js';
import { Pane } from '../src/pane.js';
import { Response } from '../src/response.js';
import { PushArrow, TargetDot } from './marks.js';

const kSmooth_s = 0.25;  // The camera follows the mean of so much before and after.

export class LivePane extends Pane {
  // view: {mode, model, tracks}; `model` is what the server says about the character and its surroundings.
  static async load(view, colours) {
    const pane = new LivePane();
    const { mode, model, tracks } = view;
    pane.mode = mode;
    pane.tracks = tracks;
    pane.colours = colours;
    pane.figure = await loadModel(model.glb);
    const joints = list(model.joints);
    pane.order = joints.map((joint) => pane.figure.joints.get(joint.name));
    pane.order.forEach((node, i) => { if (node) node.userData.of = joints[i]; });
    pane.motion = {
      rate: tracks.rate, frameCount: tracks.frameCount, worst: -1, marks: [], balance: [],
      highlight: { joints: [], colliders: [] }, colliders: list(model.colliders),
      ground: readGround(model.ground), obstacles: list(model.obstacles),
    };
    pane.build();
    pane.addMarks();
    return pane;
  }

  addMarks() {
    this.push = new PushArrow(this.colours);
    this.pushes = [this.push];
    this.targets = new Map();
    this.scene.add(this.push.object);
  }

  // {name: point}: rings around what is aimed at.
  setTargets(points) {
    for (const dot of this.targets.values()) this.scene.remove(dot.object);
    this.targets = new Map([...points].map(([name, point]) => [name, new TargetDot(point, this.colours)]));
    for (const dot of this.targets.values()) this.scene.add(dot.object);
    this.dots = [...this.targets.values()];
  }

  // Blows of the take, which change with every push.
  setMarks(marks) {
    this.scene.remove(this.response.group);
    this.motion.marks = marks;
    this.motion.rate = this.tracks.rate;
    this.response = new Response(this.motion, this.colours);
    this.scene.add(this.response.group);
  }

  pose(frame) {
    const values = this.tracks.pose(this.mode, frame);
    if (values && values.length === 7 * this.order.length) this.figure.pose(this.order, values);
    else this.figure.root.updateMatrixWorld(true);
  }

  // The root's mean place around a frame, higher or lower by what the figure's middle was at first.
  makePath() {
    const root = new Vector3();
    const rest = this.order[0]?.position.clone() ?? new Vector3();
    this.pose(0);
    const lift = this.figure.middle(new Vector3()).sub(this.order[0]?.position ?? rest);
    lift.x = lift.z = 0;
    return (frame) => {
      const reach = Math.max(1, Math.round(kSmooth_s * this.tracks.rate));
      const sum = new Vector3();
      let count = 0;
      for (let at = Math.max(0, frame - reach); at <= frame + reach; ++at) {
        const values = this.tracks.of.get(this.mode)?.frames[at];
        if (!values) continue;
        sum.add(root.fromArray(values));
        ++count;
      }
      return (count ? sum.divideScalar(count) : rest.clone()).add(lift);
    };
  }

  // The place and heading of the character, for things that are put beside it.
  stance() {
    const root = this.order[0];
    if (!root) return { x: 0, z: 0, heading: 0 };
    const ahead = new Vector3(0, 0, 1).applyQuaternion(root.quaternion);
    return { x: root.position.x, z: root.position.z, heading: Math.atan2(ahead.x, ahead.z) };
  }
}
