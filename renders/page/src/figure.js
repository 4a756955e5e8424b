// One character out of a .glb: its joints by their real names, and its pose at a frame of its animation, or as given.
import { AnimationMixer, Box3, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

// Out of base64.
export function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export function unzipped(bytes) {
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

export class Figure {
  constructor(gltf, rate) {
    this.root = gltf.scene;
    this.rate = rate;
    this.joints = new Map();
    this.list = [];
    this.readJoints(gltf.parser);
    this.mixer = new AnimationMixer(this.root);
    this.actions = gltf.animations.map((clip) => this.mixer.clipAction(clip));
    for (const action of this.actions) action.play();
  }

  // The loader changes names ("/" is not allowed there); the file's own names are found by the number of the node.
  readJoints(parser) {
    this.root.traverse((object) => {
      const node = parser.associations.get(object)?.nodes;
      if (node === undefined) return;
      object.userData.joint = parser.json.nodes[node].name ?? '';
      this.list.push(object);
      if (!this.joints.has(object.userData.joint)) this.joints.set(object.userData.joint, object);
    });
  }

  // Exactly the key of this frame. Set on the actions, not through mixer.setTime: that would wrap the last frame
  // around to the first.
  sample(frame) {
    for (const action of this.actions) action.time = frame / this.rate;
    this.mixer.update(0);
    this.root.updateMatrixWorld(true);
  }

  // Poses the joints in `order` by seven numbers each, place and rotation against the parent: what a server sends.
  pose(order, values) {
    order.forEach((joint, i) => {
      joint?.position.fromArray(values, 7 * i);
      joint?.quaternion.fromArray(values, 7 * i + 3);
    });
    this.root.updateMatrixWorld(true);
  }

  meshes() {
    const meshes = [];
    this.root.traverse((object) => { if (object.isMesh) meshes.push(object); });
    return meshes;
  }

  ownMeshes(joint) {
    const own = [];
    const visit = (object) => {
      if (object !== joint && object.userData.joint !== undefined) return;
      if (object.isMesh && !object.userData.extra) own.push(object);
      object.children.forEach(visit);
    };
    visit(joint);
    return own;
  }

  hasMesh(joint) {
    return this.ownMeshes(joint).length > 0;
  }

  // Meshes that move with the joint itself; of a joint without, those of the joints below it stand in.
  meshesOf(joint) {
    const own = this.ownMeshes(joint);
    if (own.length > 0) return own;
    return joint.children.filter((child) => child.userData.joint !== undefined)
      .flatMap((child) => this.meshesOf(child));
  }

  // Middle of the joints now, in the world.
  middle(into) {
    const box = new Box3();
    const at = new Vector3();
    for (const joint of this.list) box.expandByPoint(joint.getWorldPosition(at));
    return box.isEmpty() ? into.set(0, 1, 0) : box.getCenter(into);
  }

  box() {
    return new Box3().setFromObject(this.root);
  }
}

export async function loadFigure(glb, rate) {
  const gltf = await new GLTFLoader().parseAsync(await unzipped(bytesOf(glb)), '');
  return new Figure(gltf, rate);
}

// Loads a figure from a model that is not compressed and has no animation.
export async function loadModel(glb) {
  return new Figure(await new GLTFLoader().parseAsync(bytesOf(glb).buffer, ''), 1);
}

// The place of the figure at every frame, smoothed over half a second, so that a camera that goes along does not shake.
export function pathOf(figure, frameCount) {
  const stride = Math.max(1, Math.ceil(frameCount / 400));
  const raw = [];
  for (let frame = 0; frame < frameCount; frame += stride) {
    figure.sample(frame);
    raw.push(figure.middle(new Vector3()));
  }
  const reach = Math.max(1, Math.round(figure.rate / 2 / stride));
  const smooth = raw.map((_, i) => {
    const sum = new Vector3();
    // The mean has equally many frames before and after, also near the ends, so that a steady walk stays in the middle.
    const side = Math.min(reach, i, raw.length - 1 - i);
    for (let j = i - side; j <= i + side; ++j) sum.add(raw[j]);
    return sum.divideScalar(2 * side + 1);
  });
  return (frame) => {
    const at = Math.min(smooth.length - 1, Math.max(0, frame) / stride);
    const before = Math.floor(at);
    const after = Math.min(smooth.length - 1, before + 1);
    return smooth[before].clone().lerp(smooth[after], at - before);
  };
}
