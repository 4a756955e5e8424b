// Marks in the picture of what the user's hand does: an arrow while something is pushed, rings around what is aimed at.
import { Mesh, MeshBasicMaterial, SphereGeometry, TorusGeometry, Group, Vector3 } from 'three';
import { arrow, turnArrow } from '../src/response.js';

const kShaft = 0.5;

export class PushArrow {
  constructor(colours) {
    this.object = new Group();
    this.inner = arrow(kShaft, colours);
    this.object.add(this.inner);
    this.object.visible = false;
  }

  // Shows an arrow from a point along a drag, as long as the drag, both in the world. The mesh ends at its origin.
  show(from, drag) {
    this.object.visible = drag.length() > 1e-3;
    this.object.position.copy(from).add(drag);
    turnArrow(this.object, drag);
    this.object.scale.set(1, drag.length() / (kShaft + 0.12), 1);
    this.object.updateMatrixWorld(true);
  }

  hide() {
    this.object.visible = false;
  }
}

export class TargetDot {
  constructor(point, colours) {
    this.colour = colours.arrow;
    const material = new MeshBasicMaterial({ color: this.colour, depthTest: false, transparent: true, opacity: 0.9 });
    this.object = new Group();
    this.object.add(new Mesh(new SphereGeometry(0.025, 12, 8), material));
    for (const turn of [0, Math.PI / 2]) {
      const ring = new Mesh(new TorusGeometry(0.07, 0.007, 8, 32), material);
      ring.rotation.y = turn;
      this.object.add(ring);
    }
    for (const mesh of this.object.children) mesh.renderOrder = 9;
    this.object.position.copy(new Vector3(...point));
  }
}
