// One motion as a scene: figure, ghost, colliders, ground, obstacles, blows. With or without WebGL.
import { Color, Scene, Vector3 } from 'three';
import { loadFigure, pathOf } from './figure.js';
import { addColliders, highlightJoints, makeGhost } from './marking.js';
import { Response } from './response.js';
import { groundMesh, lights, obstacleGroup } from './scenery.js';
import { bestDirection } from './view_angle.js';

export class Pane {
  static async load(motion, colours) {
    const pane = new Pane();
    pane.motion = motion;
    pane.colours = colours;
    pane.figure = await loadFigure(motion.glb, motion.rate);
    if (motion.ghostGlb) {
      // Without its ghost a case is still worth showing.
      pane.ghostFigure = await loadFigure(motion.ghostGlb, motion.rate).catch(() => null);
    }
    pane.build();
    return pane;
  }

  // The path of the picture's middle: its place at every frame.
  makePath() {
    return pathOf(this.figure, this.motion.frameCount);
  }

  pose(frame) {
    this.figure.sample(frame);
    if (this.ghostFigure) this.ghostFigure.sample(frame);
  }

  build() {
    const { motion, colours, figure } = this;
    this.scene = new Scene();
    this.scene.background = new Color(colours.stage);
    this.middle = new Vector3();
    this.dots = [];  // Points that are marked: {object, colour}, for drawing without WebGL.
    this.path = this.makePath();
    this.pose(this.startFrame());
    const box = figure.box();
    this.radius = Math.max(0.2, box.getSize(new Vector3()).length() / 2);
    // The way from the middle of the joints to that of the visible figure, as a large head is above all joints.
    this.offset = box.getCenter(new Vector3()).sub(this.path(this.startFrame()));
    this.lights = lights(colours);
    this.obstacles = obstacleGroup(motion.obstacles, colours);
    this.ground = groundMesh(motion.ground, colours, this.middle);
    this.response = new Response(motion, colours);
    for (const mesh of figure.meshes()) mesh.castShadow = mesh.receiveShadow = true;
    this.joints = highlightJoints(figure, motion.highlight.joints, colours);
    this.colliders = addColliders(figure, motion.colliders, motion.highlight.colliders, colours);
    this.ghost = this.ghostFigure ? makeGhost(this.ghostFigure, colours) : null;
    this.scene.add(this.ground, this.obstacles, this.lights, figure.root, this.response.group);
    if (this.ghost) this.scene.add(this.ghost);
  }

  startFrame() {
    return this.motion.worst >= 0 ? this.motion.worst : 0;
  }

  show(frame) {
    this.frame = frame;
    this.pose(frame);
    this.response.show(frame);
    this.middle.copy(this.path(frame));
    this.lights.userData.follow(this.middle, this.radius);
  }

  apply(toggles) {
    if (this.ghost) this.ghost.visible = toggles.ghost;
    for (const mesh of this.colliders.all) mesh.visible = toggles.colliders;
    for (const mesh of [...this.joints.through, ...this.colliders.through]) mesh.visible = toggles.xray;
  }

  // Direction from which the failure is seen best at the worst frame.
  direction() {
    const before = this.frame ?? this.startFrame();
    this.show(this.startFrame());
    const { marked: solids } = this.colliders;
    const marked = [...this.joints.objects, ...solids];
    const blockers = this.figure.meshes().filter((mesh) =>
      !mesh.userData.extra && !marked.includes(mesh));
    const way = bestDirection({
      middle: this.middle, radius: this.radius, marked, blockers,
      solids: [0, 1].map((i) => solids.filter((mesh) => mesh.userData.solid === i)),
    });
    this.show(before);
    return way;
  }

  dispose() {
    this.scene.traverse((object) => {
      object.geometry?.dispose();
      for (const material of [object.material].flat()) material?.dispose();
      object.shadow?.dispose();
    });
  }
}
