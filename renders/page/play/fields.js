// Fields of forms, each with its name.
import { el } from '../src/dom.js';

export function labelled(name, control, more = {}) {
  return el('label', { class: 'field', ...more }, el('span', { text: name }), control);
}

const optionsOf = (pairs) => pairs.map(([value, text]) => el('option', { value, text }));

// pairs: [value, text]. Returns {element, select, set(pairs, value), value()}
export function choice(name, pairs, value, change) {
  const select = el('select', { on: { change: () => change?.(select.value) } }, ...optionsOf(pairs));
  const set = (next, wanted) => {
    const text = JSON.stringify(next);
    if (text !== set.before) select.replaceChildren(...optionsOf(next));
    set.before = text;
    if (next.some(([one]) => one === wanted)) select.value = wanted;
    else if (next.length) select.value = next[0][0];
  };
  set(pairs, value);
  return { element: labelled(name, select), select, set, value: () => select.value };
}

// A number, or '' for "as the generator presets it". Returns {element, input, value(): number or null}
export function numberField(name, { value = '', low, high, step = 'any', unit, placeholder, help, slider }, change) {
  const bounds = { min: low ?? null, max: high ?? null, step };
  const input = el('input', {
    type: 'number', value: String(value), placeholder: placeholder ?? null, title: help ?? null, inputmode: 'decimal',
    ...bounds, on: { change: () => { if (input.checkValidity()) change?.(read()); else input.reportValidity(); } },
  });
  const read = () => (input.value === '' || !Number.isFinite(input.valueAsNumber) ? null : input.valueAsNumber);
  const element = labelled(unit ? `${name}, ${unit}` : name, input);
  // The slider is for pointers only; keyboards use the number field.
  if (slider && low < high) {
    const range = el('input',
      { type: 'range', tabindex: '-1', 'aria-hidden': 'true', ...bounds, step: (high - low) / 100 });
    const place = () => { range.value = String(read() ?? (low <= 0 && high >= 0 ? 0 : (low + high) / 2)); };
    range.addEventListener('input', () => { input.value = String(Number(range.valueAsNumber.toPrecision(4))); });
    range.addEventListener('change', () => change?.(read()));
    input.addEventListener('input', place);
    place();
    element.append(range);
  }
  return { element, input, value: read };
}

// Three numbers. `value()` is null while none is given; those that are missing beside others are 0.
export function pointField(name, { value, low, high, unit, help, placeholder } = {}) {
  const inputs = ['x', 'y', 'z'].map((axis, i) => el('input', {
    type: 'number', step: 'any', min: low ?? null, max: high ?? null, 'aria-label': `${name} ${axis}`,
    placeholder: placeholder ?? axis, value: value ? String(value[i]) : '', inputmode: 'decimal',
  }));
  const element = el('fieldset', { class: 'field point', title: help ?? null },
    el('legend', { text: unit ? `${name}, ${unit}` : name }), ...inputs);
  const set = (point) => inputs.forEach((input, i) => { input.value = String(Number(point[i].toFixed(3))); });
  const read = () => (inputs.every((input) => input.value === '') ? null :
    inputs.map((input) => (Number.isFinite(input.valueAsNumber) ? input.valueAsNumber : 0)));
  return { element, inputs, set, value: read };
}

export function checkField(name, checked, change) {
  const box = el('input', { type: 'checkbox', on: { change: () => change?.(box.checked) } });
  box.checked = checked;
  const element = el('label', { class: 'check-field' }, box, el('span', { text: name }));
  return { element, box, value: () => box.checked };
}

export function button(text, click, more = {}) {
  return el('button', { type: 'button', text, on: { click }, ...more });
}

// A part of the side that can be folded.
export function panel(title, open, ...children) {
  return el('details', { class: 'panel', open }, el('summary', {}, el('h2', { text: title })), ...children);
}

// Fields, then a button that Enter presses, too. Nothing is sent while a field is out of its range.
export function form(name, submit, ...children) {
  return el('form', {
    'aria-label': name, class: 'fields',
    on: { submit: (event) => { event.preventDefault(); submit(event.submitter); } },
  }, ...children);
}
