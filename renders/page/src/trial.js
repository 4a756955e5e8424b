// Plays the open case with other values: a field for each number of its spec, and a new motion after each change. The
// generator and the checks themselves run in the page, as WebAssembly (docs/internals/wasm.md).
import { Damaged, readCase } from './case_data.js';
import { el, textButton } from './dom.js';

const isList = Array.isArray;
const escaped = (name) => String(name).replaceAll('~', '~0').replaceAll('/', '~1');
const kAxes = ['x', 'y', 'z'];

// The numbers of a spec as {pointer, path, value}, in the order of the file.
export function numbersOf(spec, path = []) {
  const pointer = path.map((name) => `/${escaped(name)}`).join('');
  if (typeof spec === 'number') return [{ pointer, path, value: spec }];
  if (spec === null || typeof spec !== 'object') return [];
  const entries = isList(spec) ? spec.map((one, i) => [i, one]) : Object.entries(spec);
  return entries.flatMap(([name, below]) => numbersOf(below, [...path, name]));
}

// A copy of the spec with another number at the path.
export function withNumber(spec, [name, ...rest], value) {
  if (name === undefined) return value;
  const copy = isList(spec) ? [...spec] : { ...spec };
  copy[name] = withNumber(spec[name], rest, value);
  return copy;
}

// The words in which a reader finds the number: {group: "sequence 1, clip 2, reach on arm_left", name: "target_m x"}
export function wordsOf(spec, path) {
  const words = [];
  const name = [];
  let at = spec;
  path.forEach((step, i) => {
    const above = path[i - 1];
    at = at[step];
    if (typeof step !== 'number') name.push(step);
    else if (typeof at === 'object' && !isList(at)) {
      name.length = 0;
      words.push(at.action ? `${at.action} on ${at.slot ?? at.part ?? 'body'}` : `${String(above).replace(/s$/, '')} ${step + 1}`);
    } else name.push(kAxes[step] ?? String(step + 1));
  });
  if (words.length === 0 && name.length > 1) words.push(name.shift());
  return { group: words.join(', '), name: name.filter((word) => word !== 'params').join(' ') };
}

// Far enough to both sides for a hand to explore; the field itself takes every number.
function rangeOf({ value, path }) {
  const isCount = Number.isInteger(value) && /_frames?$/.test(String(path.at(-1)));
  const reach = isCount ? Math.max(10, value) : Math.max(1, Math.abs(value));
  const min = isCount ? Math.max(0, value - reach) : value - reach;
  return { min, max: value + reach, step: isCount ? 1 : reach / 200 };
}

export class Trial {
  // calls: engine() promises {play(spec, check, subject): text, ms}; show(motion); back()
  constructor(data, calls) {
    this.data = data;
    this.calls = calls;
    this.spec = data.motions[0].spec;
    this.told = el('p', { class: 'trial-told', role: 'status', 'aria-live': 'polite' });
    this.fields = el('div', { class: 'trial-fields' });
    this.element = el('details', { class: 'trial', on: { toggle: () => this.element.open && this.start() } },
      el('summary', { text: 'Try other values' }), this.told, this.fields,
      textButton('Back to the stored values', '', () => this.reset(), { class: 'trial-back' }));
  }

  async start() {
    if (this.engine || this.starting) return;
    this.starting = true;
    this.told.textContent = 'The generator is started\u2026';
    try {
      this.engine = await this.calls.engine();
      this.told.textContent = `The generator started in ${Math.round(this.engine.ms)} ms. ` +
        'Change a number to see the motion and its margins.';
      this.showFields();
      // The browser compiles what it meets for the first time, which takes a while: now, not at the first change.
      setTimeout(() => this.answer());
    } catch (error) {
      this.told.textContent = `The generator cannot be started: ${error.message}`;
    }
    this.starting = false;
  }

  showFields() {
    const groups = new Map();
    for (const number of numbersOf(this.spec)) {
      const { group, name } = wordsOf(this.spec, number.path);
      if (!groups.has(group)) groups.set(group, []);
      groups.get(group).push(this.field(number, name));
    }
    this.fields.replaceChildren(...[...groups].map(([group, fields]) =>
      el('fieldset', {}, group ? el('legend', { text: group }) : null, ...fields)));
  }

  field(number, name) {
    const change = (text) => {
      if (text === '' || !Number.isFinite(Number(text))) return;
      this.spec = withNumber(this.spec, number.path, Number(text));
      this.playSoon();
    };
    const input = el('input',
      { type: 'number', step: 'any', value: String(number.value), 'data-pointer': number.pointer });
    const range = el('input', { type: 'range', tabindex: '-1', 'aria-hidden': 'true', ...rangeOf(number) });
    range.value = String(number.value);
    input.addEventListener('input', () => { range.value = input.value; change(input.value); });
    range.addEventListener('input', () => {
      input.value = String(Number(range.valueAsNumber.toPrecision(6)));
      change(input.value);
    });
    return el('label', { class: 'trial-field' }, el('span', { text: name }), input, range);
  }

  // Once for all changes between two pictures.
  playSoon() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = 0; this.play(); });
  }

  answer() {
    return this.engine.play(JSON.stringify(this.spec), this.data.check, this.data.subject);
  }

  play() {
    const begun = performance.now();
    try {
      const { motions } = readCase(JSON.parse(this.answer()));
      this.told.textContent = `Played in ${Math.round(performance.now() - begun)} ms.`;
      this.calls.show(motions[0]);
    } catch (error) {
      this.told.textContent = error instanceof Damaged ? error.message : `The generator failed: ${error.message}`;
    }
  }

  reset() {
    this.spec = this.data.motions[0].spec;
    if (this.engine) this.showFields();
    this.told.textContent = '';
    this.calls.back();
  }

  dispose() {
    cancelAnimationFrame(this.waiting);
  }
}
