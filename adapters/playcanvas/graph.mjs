// The anim component of PlayCanvas: a state for each clip, a transition for each use of `go`, and the public operations
// of the component and its layer. An operation happens in the frame in which the action starts; its duration is the
// time to watch.
//
// Each clip comes, as from a file of its own, with a root of its own name, and has a track for each joint.
import { clips, joints, keys, slopes } from '../javascript/figure.mjs';
import { makeEntity } from './engine.mjs';

const CLIPS = clips.map(({ name }) => name);
const STATES = [...CLIPS, 'mix'];
const LINEAR = 1, CUBIC = 2;
// The component plays at most 1.5 times as fast.
export const LIMITS = { timeScale: 1.5, fadeS: 0.4 / 1.5, additive: false };

const to = { type: 'choice', choices: STATES, default: STATES[1] };
const share = { type: 'number', low: 0, high: 1 };
const LONG = [0.2, 2.5], SHORT = [0.1, 1];  // Durations: long enough to see loops, and to see a change.

export class Player {
  constructor(pc, uses) {
    this.pc = pc;
    const { entity, update } = makeEntity(pc, 'figure');
    this.update = update;
    this.anim = entity.anim;
    this.nodes = new Map();
    for (const { name, parent } of joints) {
      const node = new pc.GraphNode(name);
      (this.nodes.get(parent) ?? entity).addChild(node);
      this.nodes.set(name, node);
    }
    this.takeRest();
    this.anim.loadStateGraph(stateGraph(uses));
    for (const clip of clips) this.anim.assignAnimation(clip.name, this.makeTrack(clip));
    this.anim.assignAnimation('mix.first', this.makeTrack(clips[0]));
    this.anim.assignAnimation('mix.second', this.makeTrack(clips[3]));
    this.anim.baseLayer.pause();
  }

  takeRest() {
    for (const { name, position, rotation } of joints) {
      this.nodes.get(name).setLocalPosition(...position);
      this.nodes.get(name).setLocalRotation(...rotation);
    }
  }

  makeTrack({ name, duration, tracks }) {
    const { AnimCurve, AnimData, AnimTrack } = this.pc;
    const inputs = [], outputs = [], curves = [];
    for (const joint of joints) {
      const track = tracks.find((one) => one.joint === joint.name) ?? still(joint, duration);
      const values = keys(track), slope = slopes(track);
      const rows = track.smooth ? values.flatMap((value, i) => [slope[i], value, slope[i]]) : values;
      const property = track.offsets ? 'localPosition' : 'localRotation';
      inputs.push(new AnimData(1, new Float32Array(track.times)));
      outputs.push(new AnimData(values[0].length, new Float32Array(rows.flat())));
      curves.push(new AnimCurve([this.path(`${name}_file`, track.joint, property)], inputs.length - 1,
        outputs.length - 1, track.smooth ? CUBIC : LINEAR));
    }
    return new AnimTrack(name, duration, inputs, outputs, curves);
  }

  // The address of a joint's property, as the loader of glTF files writes it. Old versions write it as one string.
  path(root, joint, property) {
    const names = [joint];
    for (let { parent } = joints.find(({ name }) => name === joint); parent;
      ({ parent } = joints.find(({ name }) => name === parent))) names.unshift(parent);
    const old = Boolean(this.pc.AnimBinder.decode);
    const entityPath = old ? [[root, ...names].join('/')] : [root, ...names];
    const address = { entityPath, component: 'graph', propertyPath: [property] };
    return old ? this.pc.AnimBinder.encode(address) : address;
  }

  row() {
    const { x, y, z } = this.nodes.get(joints[0].name).localPosition;
    const out = [x, y, z];
    for (const { localRotation: q } of this.nodes.values()) out.push(q.x, q.y, q.z, q.w);
    return out;
  }
}

const still = ({ name, parent }, duration) => ({ joint: name, axis: [0, 1, 0], times: [0, duration],
  ...(parent ? { anglesDeg: [0, 0] } : { offsets: [[0, 0, 0], [0, 0, 0]] }) });

// Each use of `go` has a transition of its own, which its trigger starts: its parameters are those of the transition.
function stateGraph(uses) {
  const gone = uses.map((use, i) => ({ use, trigger: `go${i}` })).filter(({ use }) => use.action === 'go');
  const transitions = gone.map(({ use: { params }, trigger }) => ({ from: 'ANY', to: params.to, time: params.over_s,
    priority: 0, exitTime: params.exit_share, transitionOffset: params.offset_share,
    interruptionSource: params.interruption.toUpperCase(),
    conditions: [{ parameterName: trigger, predicate: 'EQUAL_TO', value: true }] }));
  const blendTree = { type: '1D', parameter: 'mix', parameters: ['mix'], syncDurations: false,
    children: [{ name: 'first', point: 0 }, { name: 'second', point: 1 }] };
  const states = ['START', 'END', 'ANY', ...CLIPS].map((name) => ({ name, speed: 1, loop: true }));
  return { layers: [{ name: 'base', states: [...states, { name: 'mix', speed: 1, loop: true, blendTree }],
    transitions: [{ from: 'START', to: CLIPS[0], time: 0, priority: 0 }, ...transitions] }],
    parameters: { mix: { name: 'mix', type: 'FLOAT', value: 0 }, ...Object.fromEntries(gone.map(({ trigger }) =>
      [trigger, { name: trigger, type: 'TRIGGER', value: false }])) } };
}

// The actions of the manifest. Old versions cannot rebind.
export function actions(pc) {
  const known = Object.entries(operations).filter(([name]) => name !== 'rebind' || pc.AnimComponent.prototype.rebind);
  return known.map(([name, { run, ...fields }]) => ({ name, slots: ['body'], duration_s: SHORT, ...fields }));
}

export const operations = {
  play: { effect: 'cut', duration_s: LONG, params: { to: { ...to, default: STATES[0] } },
    run: (player, p) => player.anim.baseLayer.play(p.to) },
  go: { effect: 'continuous', duration_s: LONG, help: 'Sets the trigger of a transition.',
    params: { to, over_s: { type: 'number', low: 0.4, high: 1 }, exit_share: share, offset_share: { ...share, high: 0 },
      interruption: { type: 'choice', choices: ['none', 'prev_state', 'next_state', 'prev_state_next_state'] } },
    run: (player, p, i) => player.anim.setTrigger(`go${i}`) },
  start_over: { effect: 'equals', duration_s: LONG, help: 'Resets the component, returns to rest, and plays.',
    params: { to: { ...to, default: STATES[0] } },
    run: (player, p) => {
      player.anim.reset();
      player.anim.speed = 1;
      player.takeRest();
      player.anim.baseLayer.play(p.to);
    } },
  pause: { effect: 'continuous', run: (player) => player.anim.baseLayer.pause() },
  resume: { effect: 'continuous', run: (player) => player.anim.baseLayer.play() },
  rebind: { effect: 'none', run: (player) => player.anim.rebind() },
  set_time: { effect: 'cut', params: { share },
    run: (player, p) => {
      const layer = player.anim.baseLayer;
      layer.activeStateCurrentTime = p.share * layer.activeStateDuration;
    } },
  speed: { effect: 'continuous', params: { speed: { type: 'number', low: 0, high: 1.5, default: 1 } },
    run: (player, p) => { player.anim.speed = p.speed; } },
  set_mix: { effect: 'cut', help: 'Sets the parameter of the blend tree.', params: { mix: { ...share, default: 1 } },
    run: (player, p) => player.anim.setFloat('mix', p.mix) },
  odd_update: { effect: 'continuous', help: 'One update with a step that shows nothing new.',
    params: { step: { type: 'choice', choices: ['zero', 'tiny'] } },
    run: (player, p) => player.update({ zero: 0, tiny: 1e-9 }[p.step]) },
};
