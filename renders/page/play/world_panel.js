// Ground, obstacles, and how the motion is controlled.
import { el } from '../src/dom.js';
import { button, checkField, choice, form, numberField, panel } from './fields.js';
import { toEnvironment } from './spec_edit.js';

const kSpacing_m = 0.5;
const kPoints = 33;

// The same bumps whenever the same height is asked for.
function bumps(height) {
  let state = 12345;
  const next = () => { state = (1103515245 * state + 12345) % 2147483648; return state / 2147483648; };
  return Array.from({ length: kPoints * kPoints }, () => Number(((2 * next() - 1) * height).toFixed(3)));
}

// Name: {text, fields: [name, text, unit, low, high, value], ground(values)}
const kGrounds = {
  plane: { text: 'level', fields: [], ground: () => ({ type: 'plane' }) },
  slope: {
    text: 'slope',
    fields: [['slope_deg', 'Steepness', '\u00b0', 0, 60, 10], ['heading_deg', 'Rises towards', '\u00b0', -360, 360, 0]],
    ground: (values) => ({ type: 'slope', ...values }),
  },
  steps: {
    text: 'stairs',
    fields: [['start_m', 'First step after', 'm', -100, 100, 1], ['height_m', 'Step height', 'm', 0, 10, 0.15],
      ['depth_m', 'Step depth', 'm', 0.05, 100, 0.3], ['count', 'Steps', '', 1, 1000, 5],
      ['heading_deg', 'Rise towards', '\u00b0', -360, 360, 0]],
    ground: (values) => ({ type: 'steps', ...values, count: Math.round(values.count) }),
  },
  heights: {
    text: 'rough',
    fields: [['bump_m', 'Bumps up to', 'm', 0, 2, 0.06]],
    ground: ({ bump_m: bump }) => ({
      type: 'heights', columns: kPoints, rows: kPoints, spacing_m: kSpacing_m, heights_m: bumps(bump),
    }),
  },
};

// Name: [text, shape at a point]
const kObstacles = {
  wall: ['wall', ([x, , z], size) => ({ type: 'box', center_m: [x, 1, z], half_m: [size, 1, 0.1] })],
  box: ['box', ([x, , z], size) =>
    ({ type: 'box', center_m: [x, size / 2, z], half_m: [size / 2, size / 2, size / 2] })],
  ball: ['ball', ([x, , z], size) => ({ type: 'sphere', center_m: [x, size / 2, z], radius_m: size / 2 })],
  pole: ['pole', ([x, , z], size) => ({ type: 'capsule', a_m: [x, 0, z], b_m: [x, 2, z], radius_m: size / 4 })],
};

const kModeHelp = {
  kinematic: 'as the actions make it', tracking: 'joints follow it by forces', dynamic: 'gives way, keeps its balance',
};

export class WorldPanel {
  constructor(app) {
    this.app = app;
    this.ground = choice('Ground', Object.entries(kGrounds).map(([name, { text }]) => [name, text]), 'plane',
      (name) => { this.showFields(name); this.setGround(); });
    this.fields = el('div', { class: 'fields two-columns' });
    this.values = new Map();
    this.kind = choice('Obstacle', Object.entries(kObstacles).map(([name, [text]]) => [name, text]), 'wall');
    this.size = numberField('Size', { value: 0.6, low: 0.05, high: 20, unit: 'm' });
    this.ahead = numberField('Ahead', { value: 1.5, low: -50, high: 50, unit: 'm' });
    this.aside = numberField('To its left', { value: 0, low: -50, high: 50, unit: 'm' });
    this.things = el('ul', { class: 'things' });
    this.obstacles = form('Put up an obstacle', () => this.addObstacle(), this.kind.element, this.size.element,
      this.ahead.element, this.aside.element, el('button', { text: 'Put up' }));
    this.element = panel('Surroundings', false, this.ground.element, this.fields, el('h3', { text: 'Obstacles' }),
      this.things, this.obstacles);
  }

  update({ spec }) {
    this.environment = spec.environment ?? {};
    const ground = this.environment.ground ?? { type: 'plane' };
    if (Object.hasOwn(kGrounds, ground.type) && !this.element.contains(document.activeElement)) {
      this.ground.select.value = ground.type;
      this.showFields(ground.type, ground);
    }
    this.things.replaceChildren(...(this.environment.obstacles ?? []).map(({ name }) => el('li', {},
      el('span', { text: name }), button('Remove', () => this.removeObstacle(name),
        { class: 'small', 'aria-label': `Remove the obstacle ${name}` }))));
  }

  showFields(name, given = {}) {
    this.values.clear();
    this.fields.replaceChildren(...kGrounds[name].fields.map(([key, text, unit, low, high, value]) => {
      const field = numberField(text, { unit, low, high, value: given[key] ?? value }, () => this.setGround());
      this.values.set(key, { field, value });
      return field.element;
    }));
  }

  // Around where the figure stands now, so that a flight of steps is not behind it.
  setGround() {
    const values = Object.fromEntries([...this.values].map(([key, { field, value }]) => [key, field.value() ?? value]));
    const { x, z } = this.app.stance();
    const place = { position_m: [x, 0, z].map((value) => Number(value.toFixed(3))) };
    const obstacles = this.environment.obstacles ?? [];
    const { position_m, heading_deg } = this.environment;
    const moved = obstacles.length ? { position_m, heading_deg } : place;  // Obstacles stay where they are.
    const clean = Object.fromEntries(Object.entries(moved).filter(([, value]) => value !== undefined));
    this.app.change({ environment: { ...clean, ground: kGrounds[this.ground.value()].ground(values), obstacles } });
  }

  addObstacle() {
    const { x, z, heading } = this.app.stance();
    const [ahead, aside] = [this.ahead.value() ?? 0, this.aside.value() ?? 0];
    const world = [x + ahead * Math.sin(heading) + aside * Math.cos(heading), 0,
      z + ahead * Math.cos(heading) - aside * Math.sin(heading)];
    const at = toEnvironment(this.environment, world).map((value) => Number(value.toFixed(3)));
    const obstacles = this.environment.obstacles ?? [];
    const kind = this.kind.value();
    let number = obstacles.length + 1;
    while (obstacles.some(({ name }) => name === `${kind}_${number}`)) ++number;
    const shape = kObstacles[kind][1](at, this.size.value() ?? 0.6);
    const added = { name: `${kind}_${number}`, shape };
    this.app.change({ environment: { ...this.environment, obstacles: [...obstacles, added] } });
  }

  removeObstacle(name) {
    const obstacles = (this.environment.obstacles ?? []).filter((one) => one.name !== name);
    this.app.change({ environment: { ...this.environment, obstacles } });
  }
}

// Chooses the modes that are computed and shown side by side.
export class ModesField {
  constructor(app) {
    this.app = app;
    this.boxes = new Map(app.catalogue.modes.map((mode) => [mode, checkField(mode, false, () => this.choose(mode))]));
    for (const [mode, { element }] of this.boxes) if (kModeHelp[mode]) element.title = `${mode}: ${kModeHelp[mode]}`;
    this.element = el('fieldset', { class: 'modes' }, el('legend', { text: 'Modes, side by side' }),
      ...[...this.boxes.values()].map(({ element }) => element));
  }

  update({ modes }) {
    for (const [mode, { box }] of this.boxes) box.checked = modes.includes(mode);
  }

  choose(mode) {
    const modes = this.app.catalogue.modes.filter((one) => this.boxes.get(one).value());
    if (modes.length) this.app.change({ modes });
    else this.boxes.get(mode).box.checked = true;  // One is always shown.
  }
}
