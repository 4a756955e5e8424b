// Blows and balance: an arrow for some frames after each blow, a disc where the zero moment point is.
import {
  ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, RingGeometry, CircleGeometry, Vector3,
} from 'three';

const kUp = new Vector3(0, 1, 0);
const kShownSeconds = 0.3;

// Ends at the origin, coming from below. Points with the impulse when it is turned from kUp to it.
export function arrow(length, colours) {
  const material = new MeshBasicMaterial({ color: colours.arrow, depthTest: false, transparent: true });
  const shaft = new Mesh(new CylinderGeometry(0.014, 0.014, length, 10), material);
  shaft.position.y = -0.1 - length / 2;
  const tip = new Mesh(new ConeGeometry(0.045, 0.12, 14), material);
  tip.position.y = -0.06;
  const group = new Group();
  group.add(shaft, tip);
  shaft.renderOrder = tip.renderOrder = 8;
  return group;
}

export function turnArrow(object, impulse) {
  object.quaternion.setFromUnitVectors(kUp, impulse.lengthSq() > 0 ? impulse.clone().normalize() : kUp);
}

// Ends at the point that was hit. Longer for a harder blow, within what fits into the picture.
function blow(mark, colours) {
  const impulse = new Vector3(...mark.impulse);
  const object = arrow(Math.min(0.9, 0.3 + 0.01 * impulse.length()), colours);
  object.position.set(...mark.point);
  turnArrow(object, impulse);
  return object;
}

function disc(colours) {
  const inside = new MeshBasicMaterial({ color: colours.good, transparent: true, opacity: 0.9, depthTest: false });
  const group = new Group();
  group.add(new Mesh(new CircleGeometry(0.03, 24), inside), new Mesh(new RingGeometry(0.05, 0.065, 32), inside));
  for (const mesh of group.children) {
    mesh.rotation.x = -Math.PI / 2;
    mesh.renderOrder = 7;
  }
  group.userData.material = inside;
  return group;
}

export class Response {
  constructor(motion, colours) {
    this.motion = motion;
    this.colours = colours;
    this.group = new Group();
    this.arrows = motion.marks.filter((mark) => mark.point && mark.impulse)
      .map((mark) => ({ frame: mark.frame, object: blow(mark, colours) }));
    for (const { object } of this.arrows) this.group.add(object);
    this.disc = disc(colours);
    this.group.add(this.disc);
  }

  show(frame) {
    const shown = kShownSeconds * this.motion.rate;
    for (const { frame: at, object } of this.arrows) object.visible = frame >= at && frame <= at + shown;
    const balance = this.motion.balance[frame];
    this.disc.visible = Boolean(balance);
    if (!balance) return;
    this.disc.position.set(balance.zmp[0], balance.zmp[1] + 0.005, balance.zmp[2]);
    const lost = balance.margin !== null && balance.margin < 0;
    this.disc.userData.material.color.set(lost ? this.colours.red : this.colours.good);
  }
}
