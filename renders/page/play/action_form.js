// One action of a clip: slot, action, parameters with their ranges, when and for how long.
import { el } from '../src/dom.js';
import { button, choice, numberField, pointField } from './fields.js';
import { actionsOn, attachmentsOf, partsOf } from './spec_edit.js';

const kFirst = ['walk', 'run', 'aim', 'look_at', 'reach'];
const kLong = new Set(['walk', 'run', 'aim', 'look_at', 'weapon_hold', 'touch']);
const kPreset = 'preset';

// The names to choose from: points of objects, and those that aim.
function pointNames(app) {
  const aims = (app.model?.aims ?? []).flatMap((aim) => aim.points ?? []);
  return [...new Set(aims)];
}

function paramField(app, param) {
  const [low, high] = param.low < param.high ? [param.low, param.high] : [undefined, undefined];
  const name = param.name;
  const range = low === undefined ? '' : ` ${low} to ${high}.`;
  const help = `${param.help ?? ''}${range}`;
  const preset = param.preset === undefined || param.preset === null ? kPreset : `${kPreset} ${param.preset}`;
  if (param.type === 'number') {
    const slider = low !== undefined && high - low <= 1000;
    return numberField(name, { low, high, help, placeholder: preset, slider });
  }
  if (param.type === 'three numbers') return pointField(name, { low, high, help });
  if (param.type === 'name') {
    const field = choice(name, [['', kPreset], ...pointNames(app).map((point) => [point, point])], '');
    return { element: field.element, value: () => field.value() || null };
  }
  const words = String(param.type).split(' or ');
  const field = choice(name, [['', kPreset], ...words.map((word) => [word, word])], '');
  field.element.title = help;
  return { element: field.element, value: () => field.value() || null };
}

export class ActionForm {
  // `remove` is missing for the only one.
  constructor(app, number, remove) {
    this.app = app;
    this.slot = choice('Slot', [], '', () => this.showActions());
    this.action = choice('Action', [], '', () => this.showParams());
    this.help = el('p', { class: 'dim' });
    this.params = el('div', { class: 'fields two-columns' });
    this.duration = numberField('Duration', { value: 1, low: 0, high: 60, unit: 's' });
    this.start = numberField('Starts after', { value: 0, low: 0, high: 60, unit: 's' });
    this.speed = numberField('Speed', { value: 1, low: 0.1, high: 10 });
    this.blendIn = numberField('Comes in over', { value: 0.25, low: 0, high: 10, unit: 's' });
    this.blendOut = numberField('Fades out over', { value: 0, low: 0, high: 10, unit: 's' });
    this.more = el('details', {}, el('summary', { text: 'More timing' }), el('div', { class: 'fields two-columns' },
      this.speed.element, this.blendIn.element, this.blendOut.element));
    this.element = el('fieldset', { class: 'action' }, el('legend', { text: `Action ${number}` }),
      el('div', { class: 'fields two-columns' }, this.slot.element, this.action.element), this.help, this.params,
      el('div', { class: 'fields two-columns' }, this.duration.element, this.start.element), this.more,
      remove ? button('Remove this action', remove, { class: 'small' }) : null);
  }

  // Another character or other parts: what is still there stays chosen.
  update(spec) {
    const { catalogue } = this.app;
    this.spec = spec;
    this.parts = partsOf(catalogue, spec);
    const slots = [...this.parts].filter(([, part]) => actionsOn(catalogue, part).length);
    const moving = slots.find(([, part]) => actionsOn(catalogue, part).some(({ name }) => name === kFirst[0]));
    this.slot.set(slots.map(([slot]) => [slot, slot]), this.slot.value() || moving?.[0]);
    this.showActions();
  }

  showActions() {
    const actions = actionsOn(this.app.catalogue, this.parts.get(this.slot.value()));
    const wanted = this.action.value() || kFirst.find((name) => actions.some((action) => action.name === name));
    this.action.set(actions.map(({ name }) => [name, name]), wanted);
    this.actions = actions;
    this.showParams();
  }

  showParams() {
    const action = this.actions.find(({ name }) => name === this.action.value());
    const key = JSON.stringify([action, attachmentsOf(this.spec), pointNames(this.app)]);
    if (key === this.key) return;
    const other = action?.name !== this.chosen?.name;
    this.key = key;
    this.chosen = action;
    this.help.textContent = action?.help ?? '';
    this.fields = (action?.params ?? []).map((param) => [param.name, paramField(this.app, param)]);
    this.params.replaceChildren(...this.fields.map(([, field]) => field.element));
    if (other) this.duration.input.value = kLong.has(action?.name) ? '3' : '1';
    this.blendIn.element.hidden = action?.timing !== 'course' || action?.layer === 'additive';
    this.blendOut.element.hidden = action?.layer === 'overwrite';
  }

  read(rate) {
    const frames = (field) => Math.round((field.value() ?? 0) * rate);
    const params = Object.fromEntries(this.fields.map(([name, field]) => [name, field.value()])
      .filter(([, value]) => value !== null));
    const entry = { action: this.chosen.name, slot: this.slot.value(), duration_frames: frames(this.duration) };
    if (Object.keys(params).length) entry.params = params;
    if (frames(this.start)) entry.start_frame = frames(this.start);
    if ((this.speed.value() ?? 1) !== 1) entry.speed = this.speed.value();
    for (const [key, field] of [['blend_in_frames', this.blendIn], ['blend_out_frames', this.blendOut]])
      if (!field.element.hidden && frames(field)) entry[key] = Math.min(600, frames(field));
    return entry;
  }
}
