// The public operations of AnimationGroup, each as an action of the manifest with a function that carries it out. An
// operation happens in the frame in which the action starts; its duration is the time to watch.
//
// `effect` says what the manual of Babylon.js promises: speeds and pauses never make a pose jump, and blending starts
// from the pose that there is. After all groups are stopped and bones are at rest again, a group plays as if it were
// new.
import { clips, joints, keys, slopes } from '../javascript/figure.mjs';
import { clock } from './engine.mjs';

const CLIPS = clips.map(({ name }) => name);
const FPS = 60;  // Keys of Babylon.js stand at frames.
// A clip plays 1.5 times as fast at most, in a scene that is 1.2 times as fast, and one additive clip comes on top.
export const LIMITS = { timeScale: 1.8, fadeS: 0.4, additive: true };

const clip = { type: 'choice', choices: ['last', ...CLIPS], help: 'last: the one that was started last.' };
const one = { type: 'choice', choices: CLIPS };
const speed = { type: 'number', low: -1.5, high: 1.5, default: 1, special: [-1, 0.5] };
const share = { type: 'number', low: 0, high: 1 };
const loop = { type: 'flag' };
const LONG = [0.2, 2.5], SHORT = [0.1, 1];  // Durations: long enough to see loops, and to see a change.

// One figure with its groups. Its joints are transform nodes or the bones of a skeleton.
export class Player {
  constructor(BABYLON, engine, asBones) {
    this.B = BABYLON;
    this.scene = new BABYLON.Scene(engine);
    this.scene.useRightHandedSystem = true;
    this.asBones = asBones;
    BABYLON.Animation.AllowMatricesInterpolation = true;
    this.targets = asBones ? this.makeBones() : this.makeNodes();
    this.groups = new Map(clips.map((source) => [source.name, this.makeGroup(source)]));
    this.current = this.last = this.groups.get(CLIPS[0]);
    this.added = this.fade = null;
  }

  makeNodes() {
    const nodes = new Map();
    for (const { name, parent } of joints) {
      const node = new this.B.TransformNode(name, this.scene);
      if (parent) node.parent = nodes.get(parent);
      nodes.set(name, node);
    }
    this.takeRest(nodes);
    return nodes;
  }

  makeBones() {
    this.skeleton = new this.B.Skeleton('figure', 'figure', this.scene);
    const bones = new Map();
    for (const { name, parent, position, rotation } of joints) {
      bones.set(name, new this.B.Bone(name, this.skeleton, bones.get(parent) ?? null, this.matrix(rotation, position)));
    }
    return bones;
  }

  matrix(rotation, position) {
    const { Matrix, Quaternion, Vector3 } = this.B;
    return Matrix.Compose(Vector3.One(), new Quaternion(...rotation), new Vector3(...position));
  }

  makeGroup({ name, tracks }) {
    const group = new this.B.AnimationGroup(name, this.scene);
    for (const track of tracks) group.addTargetedAnimation(this.makeAnimation(track), this.targets.get(track.joint));
    return group;
  }

  makeAnimation(track) {
    const { Animation, Quaternion, Vector3 } = this.B;
    const { position, rotation } = joints.find(({ name }) => name === track.joint);
    const moved = Boolean(track.offsets);
    const wrap = (numbers) => (moved ? new Vector3(...numbers) : new Quaternion(...numbers));
    const value = (numbers) => {
      if (!this.asBones) return wrap(numbers);
      return moved ? this.matrix(rotation, numbers) : this.matrix(numbers, position);
    };
    const property = this.asBones ? '_matrix' : moved ? 'position' : 'rotationQuaternion';
    const type = this.asBones ? Animation.ANIMATIONTYPE_MATRIX
      : moved ? Animation.ANIMATIONTYPE_VECTOR3 : Animation.ANIMATIONTYPE_QUATERNION;
    const animation = new Animation(track.joint, property, FPS, type, Animation.ANIMATIONLOOPMODE_CYCLE);
    const slope = slopes(track).map((numbers) => wrap(numbers.map((number) => number / FPS)));
    animation.setKeys(keys(track).map((numbers, i) => ({ frame: track.times[i] * FPS, value: value(numbers),
      ...(track.smooth && !this.asBones && { inTangent: slope[i], outTangent: slope[i] }) })));
    return animation;
  }

  takeRest(targets) {
    if (this.asBones) this.skeleton.returnToRest();
    else for (const { name, position, rotation } of joints) {
      targets.get(name).position = new this.B.Vector3(...position);
      targets.get(name).rotationQuaternion = new this.B.Quaternion(...rotation);
    }
  }

  find(name) {
    return name === 'last' ? this.last : this.groups.get(name);
  }

  // Starts a group alone: the others stop, except for the one that is added.
  start(group, looped, ratio, blending = 0, from = group.from, to = group.to) {
    for (const other of this.groups.values()) other.stop();
    this.fade = null;
    for (const { animation } of group.targetedAnimations) {
      animation.enableBlending = blending > 0;
      animation.blendingSpeed = blending;
    }
    this.current = this.last = group.start(looped, ratio, from, to);
  }

  stopAll() {
    for (const group of [...this.groups.values(), ...(this.added ? [this.added] : [])]) group.stop();
    this.added = this.fade = null;
    this.scene.stopAllAnimations();
    this.takeRest(this.targets);
  }

  // Lets as much time go by as all groups need that do not loop, so that they must have ended. The others stop.
  letEnd() {
    let waitS = 0;
    for (const group of [...this.groups.values(), ...(this.added ? [this.added] : [])]) {
      const ends = group.isPlaying && !group.loopAnimation && Math.abs(group.speedRatio) > 0.1;
      if (ends) waitS = Math.max(waitS, (group.to - group.from) / FPS / Math.abs(group.speedRatio));
      else group.stop();
    }
    for (let passedS = 0; passedS < waitS / this.scene.animationTimeScale; passedS += 0.1) this.advance(0.1);
    this.advance(0.1);
    this.takeRest(this.targets);
  }

  // Lets time go by, and moves the weights of a cross-fade as the manual does it: before the animations.
  advance(seconds) {
    clock.ms += seconds * 1000;
    if (this.fade) {
      const { from, to, overS } = this.fade;
      const weight = Math.min(1, (this.fade.atS += seconds) / overS);
      from.setWeightForAllAnimatables(1 - weight);
      to.setWeightForAllAnimatables(weight);
      if (weight === 1) {
        from.stop();
        this.fade = null;
      }
    }
    this.scene.animate();
  }

  // A bone shows a matrix. No clip scales it, so a scale that it has appears as the length of the quaternion.
  row() {
    const { Quaternion, Vector3 } = this.B;
    const out = [], scale = new Vector3(), turned = new Quaternion(), moved = new Vector3();
    for (const target of this.targets.values()) {
      if (this.asBones) target.getLocalMatrix().decompose(scale, turned, moved);
      const q = this.asBones ? turned.scaleInPlace(scale.y) : target.rotationQuaternion;
      if (out.length === 0) out.push(...(this.asBones ? moved : target.position).asArray());
      out.push(q.x, q.y, q.z, q.w);
    }
    return out;
  }
}

// The actions of the manifest.
export function actions() {
  return Object.entries(operations).map(([name, { run, ...fields }]) =>
    ({ name, slots: ['body'], duration_s: SHORT, ...fields }));
}

const within = (group, part) => group.from + part * (group.to - group.from);

export const operations = {
  start: { effect: 'cut', duration_s: LONG, params: { clip: one, loop, speed },
    run: (player, p) => player.start(player.find(p.clip), p.loop, p.speed) },
  start_part: { effect: 'cut', duration_s: LONG, help: 'Plays from one frame to another, once.',
    params: { clip: one, from: share, to: { ...share, default: 0.5 }, speed },
    run: (player, p) => {
      const group = player.find(p.clip);
      player.start(group, false, p.speed, 0, within(group, p.from), within(group, p.to));
    } },
  start_over: { effect: 'equals', duration_s: LONG, params: { clip: one },
    help: 'Stops all groups, returns to rest, and starts one as after loading.',
    run: (player, p) => {
      player.stopAll();
      player.scene.animationTimeScale = 1;
      player.start(player.find(p.clip), true, 1);
    } },
  stop_all: { effect: 'rest', run: (player) => player.stopAll() },
  let_end: { effect: 'rest', help: 'Waits, unseen, until all groups that do not loop have ended, and returns to rest.',
    run: (player) => player.letEnd() },
  blend_to: { effect: 'continuous', duration_s: LONG,
    help: 'Starts a group that blends in from the pose that there is.',
    params: { clip: { ...one, default: CLIPS[1] }, loop, speed,
      blending: { type: 'number', low: 0.01, high: 0.04, default: 0.04, help: 'Share of each frame.' } },
    run: (player, p) => player.start(player.find(p.clip), p.loop, p.speed, p.blending) },
  cross_fade: { effect: 'continuous', duration_s: LONG, help: 'Moves the weights of two groups that loop.',
    params: { to: { ...one, default: CLIPS[1] }, speed, over_s: { type: 'number', low: 0.4, high: 1, default: 0.5 } },
    run: (player, p) => {
      const from = player.current, to = player.find(p.to);
      if (player.fade || from === to || !from.isPlaying || !from.loopAnimation) return;
      from.setWeightForAllAnimatables(1);
      to.stop();
      to.start(true, p.speed);
      to.setWeightForAllAnimatables(0);
      player.fade = { from, to, overS: p.over_s, atS: 0 };
      player.current = player.last = to;
    } },
  add: { effect: 'cut', duration_s: LONG, help: 'Plays the additive copy of a clip on top.',
    params: { clip: one, reference: share, weight: { type: 'number', low: 0, high: 1, default: 1 } },
    run: (player, p) => {
      player.added?.stop();
      const group = player.find(p.clip), { AnimationGroup } = player.B;
      player.added = AnimationGroup.MakeAnimationAdditive(group, within(group, p.reference), undefined, true, 'added');
      player.added.start(true, 1, undefined, undefined, true);
      player.added.setWeightForAllAnimatables(p.weight);
    } },
  stop: { effect: 'cut', params: { clip }, run: (player, p) => player.find(p.clip).stop() },
  reset: { effect: 'cut', params: { clip }, run: (player, p) => player.find(p.clip).reset() },
  go_to: { effect: 'cut', params: { clip, share },
    run: (player, p) => player.find(p.clip).goToFrame(within(player.find(p.clip), p.share)) },
  pause: { effect: 'continuous', params: { clip }, run: (player, p) => player.find(p.clip).pause() },
  resume: { effect: 'continuous', params: { clip, by: { type: 'choice', choices: ['play', 'restart'] } },
    run: (player, p) => {
      const group = player.find(p.clip);
      if (group.isStarted) group[p.by](...(p.by === 'play' ? [group.loopAnimation] : []));
    } },
  speed: { effect: 'continuous', params: { clip, speed: { ...speed, default: -1 } },
    run: (player, p) => { player.find(p.clip).speedRatio = p.speed; } },
  set_weight: { effect: 'cut', params: { clip, weight: share },
    run: (player, p) => player.find(p.clip).setWeightForAllAnimatables(p.weight) },
  scene_speed: { effect: 'continuous', params: { speed: { type: 'number', low: 0.8, high: 1.2, default: 1 } },
    run: (player, p) => { player.scene.animationTimeScale = p.speed; } },
  skip: { effect: 'cut', help: 'One update with a step of another length.',
    params: { step_s: { type: 'number', low: 0, high: 10, special: clips.map(({ duration }) => duration) } },
    run: (player, p) => player.advance(p.step_s) },
  odd_update: { effect: 'continuous', help: 'One update with a step that shows nothing new.',
    params: { step: { type: 'choice', choices: ['zero', 'tiny'] } },
    run: (player, p) => player.advance({ zero: 0, tiny: 1e-9 }[p.step]) },
};
