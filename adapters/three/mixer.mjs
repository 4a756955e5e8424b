// The public operations of AnimationMixer and AnimationAction, each as an action of the manifest with a function that
// carries it out. An operation happens in the frame in which the action starts; its duration is the time to watch.
//
// An action that ends keeps its last pose (clampWhenFinished): one that leaves the figure instead may jump, by design,
// in a frame that only the engine knows.
//
// `effect` says what the manual of three.js promises: speeds may change at once, poses jump only where time or weight
// is set, stopAllAction restores the rest pose, and an action that is reset plays as if it had never played before.
import { clips } from '../javascript/figure.mjs';

const CLIPS = clips.map(({ name }) => name);
const LENGTHS = clips.map(({ duration }) => duration);
// A clip plays 1.5 times as fast at most, in a mixer that is 1.2 times as fast, and one additive clip comes on top.
export const LIMITS = { timeScale: 1.8, fadeS: 0.4 / 1.2, additive: true };

const clip = { type: 'choice', choices: ['last', ...CLIPS], help: 'last: the one that was played last.' };
const other = { type: 'choice', choices: CLIPS, default: CLIPS[1] };
const seconds = (low, high, special = []) => ({ type: 'number', low, high, default: Math.max(low, 0.5), special });
const scale = { type: 'number', low: -1.5, high: 1.5, default: 1, special: [-1, 0, 0.5] };
const flag = { type: 'flag' };
const LONG = [0.2, 2.5], SHORT = [0.1, 1];  // Durations: long enough to see loops, and to see a change.
const fade = { over_s: seconds(0.4, 1), at_once: { ...flag, help: 'Fades in 0 s.' } };
const fadeS = ({ over_s: seconds, at_once: atOnce }) => (atOnce ? 0 : seconds);
const LOOPS = { repeat: 'LoopRepeat', ping_pong: 'LoopPingPong', once: 'LoopOnce' };

// One figure with its mixer. `touched` remembers by action what the timeline itself has set, because only that may
// outlast a reset.
export class Player {
  constructor(THREE, scene, animations, joints) {
    this.THREE = THREE;
    this.animations = animations;
    this.bones = joints.map(({ name }) => scene.getObjectByName(name));
    this.mixer = new THREE.AnimationMixer(scene);
    this.clips = new Map();
    this.touched = new Map();
    this.last = this.find(CLIPS[0]);
  }

  // The action of a clip. The additive copy of a clip is made when it is asked for first.
  find(name, additiveFrom) {
    if (name === 'last') return this.last;
    const key = additiveFrom === undefined ? name : `${name}+${additiveFrom}`;
    if (!this.clips.has(key)) {
      const original = this.animations.find((one) => one.name === name);
      this.clips.set(key, additiveFrom === undefined ? original
        : this.THREE.AnimationUtils.makeClipAdditive(original.clone(), additiveFrom));
    }
    return this.mixer.clipAction(this.clips.get(key));
  }

  touch(action, ...names) {
    const set = this.touched.get(action) ?? new Set();
    names.forEach((name) => set.add(name));
    this.touched.set(action, set);
    return action;
  }

  // Gives back what the timeline has set. What the engine has changed by itself is left to the engine.
  untouch() {
    this.mixer.timeScale = 1;
    for (const [action, names] of this.touched) {
      if (names.has('scale')) action.setEffectiveTimeScale(1);
      if (names.has('weight')) action.setEffectiveWeight(1);
      if (names.has('loop')) {
        action.setLoop(this.THREE.LoopRepeat, Infinity);
        Object.assign(action, { clampWhenFinished: false, zeroSlopeAtStart: true, zeroSlopeAtEnd: true });
      }
    }
    this.touched.clear();
  }

  actions() {
    return [...this.clips.values()].map((one) => this.mixer.clipAction(one)).filter((one) => one.isScheduled());
  }

  row() {
    const out = this.bones[0].position.toArray();
    for (const { quaternion: q } of this.bones) out.push(q.x, q.y, q.z, q.w);
    return out;
  }
}

// The actions of the manifest.
export function actions() {
  return Object.entries(operations).map(([name, { run, ...fields }]) =>
    ({ name, slots: ['body'], duration_s: SHORT, ...fields }));
}

export const operations = {
  play: { effect: 'cut', duration_s: LONG, params: { clip, loop: { type: 'choice', choices: Object.keys(LOOPS) },
      repetitions: { type: 'integer', low: 0, high: 3, help: '0: without end.' },
      slope_start: { ...flag, default: true }, slope_end: { ...flag, default: true } },
    run: (player, p) => {
      const action = player.touch(player.find(p.clip), 'loop');
      action.setLoop(player.THREE[LOOPS[p.loop]], p.repetitions || Infinity);
      Object.assign(action,
        { clampWhenFinished: true, zeroSlopeAtStart: p.slope_start, zeroSlopeAtEnd: p.slope_end });
      player.last = action.play();
    } },
  add: { effect: 'cut', duration_s: LONG,
    help: 'Plays the additive copy of a clip, and stops the one that was added before.',
    params: { clip: { ...other, default: CLIPS[0] }, reference_frame: { type: 'integer', low: 0, high: 20 } },
    run: (player, p) => {
      player.added?.stop();
      player.last = player.added = player.find(p.clip, p.reference_frame).play();
    } },
  stop: { effect: 'cut', params: { clip }, run: (player, p) => player.find(p.clip).stop() },
  reset: { effect: 'cut', params: { clip }, run: (player, p) => player.find(p.clip).reset() },
  stop_all: { effect: 'rest', run: (player) => player.mixer.stopAllAction() },
  start_over: { effect: 'equals', duration_s: LONG, params: { clip: { ...other, default: CLIPS[0] } },
    help: 'Stops all actions, takes back the settings of the timeline, then resets and plays one.',
    run: (player, p) => {
      player.mixer.stopAllAction();
      player.untouch();
      player.last = player.find(p.clip).reset().play();
    } },
  fade_in: { effect: 'cut', params: { clip, ...fade },
    run: (player, p) => player.find(p.clip).fadeIn(fadeS(p)) },
  fade_out: { effect: 'cut', params: { clip, ...fade },
    run: (player, p) => player.find(p.clip).fadeOut(fadeS(p)) },
  cross_fade: { effect: 'cut', duration_s: LONG, params: { clip, to: other, ...fade, warp: flag },
    run: (player, p) => {
      const to = player.find(p.to).play();
      player.last = player.find(p.clip).play().crossFadeTo(to, fadeS(p), p.warp);
    } },
  fade_to: { effect: 'continuous', duration_s: LONG, params: { to: other, over_s: seconds(0.4, 1), warp: flag },
    help: 'Cross-fades to a clip that starts afresh, where one single action plays with its full weight.',
    run: (player, p) => {
      const [from, ...rest] = player.actions().filter((one) => one.enabled && !(one.getEffectiveWeight() === 0));
      const to = player.find(p.to);
      if (!from || rest.length > 0 || from === to || from.getEffectiveWeight() !== 1) return;
      player.last = from.crossFadeTo(to.reset().play(), p.over_s, p.warp);
    } },
  time_scale: { effect: 'continuous', params: { clip, scale: { ...scale, default: -1 } },
    run: (player, p) => player.touch(player.find(p.clip), 'scale').setEffectiveTimeScale(p.scale) },
  set_duration: { effect: 'continuous', params: { clip, length_s: seconds(1.2, 3, LENGTHS) },
    run: (player, p) => player.touch(player.find(p.clip), 'scale').setDuration(p.length_s) },
  warp: { effect: 'continuous', params: { clip, from: scale, to: { ...scale, default: 0.5 }, over_s: seconds(0, 1) },
    run: (player, p) => player.touch(player.find(p.clip), 'scale').warp(p.from, p.to, p.over_s) },
  halt: { effect: 'continuous', params: { clip, over_s: seconds(0, 1) },
    run: (player, p) => player.touch(player.find(p.clip), 'scale').halt(p.over_s) },
  pause: { effect: 'continuous', params: { clip, paused: { ...flag, default: true } },
    run: (player, p) => { player.find(p.clip).paused = p.paused; } },
  start_at: { effect: 'cut', params: { clip, wait_s: seconds(0, 0.5) },
    run: (player, p) => player.find(p.clip).startAt(player.mixer.time + p.wait_s).play() },
  sync_with: { effect: 'cut', params: { clip, to: other },
    run: (player, p) => player.touch(player.find(p.clip), 'scale').syncWith(player.find(p.to)) },
  set_weight: { effect: 'cut', params: { clip, weight: { type: 'number', low: 0, high: 1, special: [0.5] } },
    run: (player, p) => player.touch(player.find(p.clip), 'weight').setEffectiveWeight(p.weight) },
  set_time: { effect: 'cut', params: { clip, share: { type: 'number', low: 0, high: 1, help: 'Of the clip.' } },
    run: (player, p) => {
      const action = player.find(p.clip);
      action.time = p.share * action.getClip().duration;
    } },
  mixer_speed: { effect: 'continuous', params: { speed: { type: 'number', low: 0.8, high: 1.2, default: 1 } },
    run: (player, p) => { player.mixer.timeScale = p.speed; } },
  skip: { effect: 'cut', help: 'One update with a step of another length.',
    params: { step_s: { type: 'number', low: 0, high: 10, special: [1e-9, ...LENGTHS] } },
    run: (player, p) => player.mixer.update(p.step_s) },
  odd_update: { effect: 'continuous', help: 'One update with a step that shows nothing new.',
    params: { step: { type: 'choice', choices: ['zero', 'tiny', 'nan'] } },
    run: (player, p) => player.mixer.update({ zero: 0, tiny: 1e-9, nan: NaN }[p.step]) },
};
