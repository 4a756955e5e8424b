// The spec as text. What could as well have other values is grey.
import { el } from './dom.js';

const kLineLength = 96;

// Signs that cannot be seen, or that turn the order of the text around, are written as JSON can write every sign.
const kUnseen = /[\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;
const quoted = (value) =>
  JSON.stringify(value).replace(kUnseen, (sign) => `\\u${sign.charCodeAt(0).toString(16).padStart(4, '0')}`);

const escaped = (name) => String(name).replaceAll('~', '~0').replaceAll('/', '~1');

function short(value) {
  if (Array.isArray(value)) return `[${value.map(short).join(', ')}]`;
  if (value && typeof value === 'object')
    return `{${Object.entries(value).map(([k, v]) => `${quoted(k)}: ${short(v)}`).join(', ')}}`;
  return quoted(value);
}

const isNested = (value) => value !== null && typeof value === 'object' && Object.keys(value).length > 0;

// Adds [text, isFree] pieces. Short values stay on one line, as in the examples.
function write(pieces, value, pointer, indent, free, inFree) {
  const grey = inFree || free.has(pointer);
  const greyBelow = [...free].some((field) => field.startsWith(`${pointer}/`));
  if (!isNested(value) || (!greyBelow && indent.length + short(value).length <= kLineLength)) {
    pieces.push([short(value), grey]);
    return;
  }
  const isList = Array.isArray(value);
  const onOneLine = indent.length + short(value).length <= kLineLength;
  const inner = onOneLine ? '' : `\n${indent}  `;
  pieces.push([isList ? '[' : '{', grey]);
  Object.entries(value).forEach(([name, below], i) => {
    const at = `${pointer}/${escaped(name)}`;
    const greyName = grey || free.has(at);
    pieces.push([(i ? (onOneLine ? ', ' : ',') : '') + inner, false]);
    if (!isList) pieces.push([`${quoted(name)}: `, greyName]);
    write(pieces, below, at, onOneLine ? indent : `${indent}  `, free, grey);
  });
  pieces.push([(onOneLine ? '' : `\n${indent}`) + (isList ? ']' : '}'), grey]);
}

export function specPieces(spec, free) {
  const pieces = [];
  write(pieces, spec, '', '', free, false);
  return pieces;
}

export function specElement(motion) {
  if (motion.spec === null) return null;
  const code = el('code');
  for (const [text, grey] of specPieces(motion.spec, motion.freeFields))
    code.append(grey ? el('span', { class: 'free', text }) : text);
  const pre = el('pre', { tabindex: '0', 'aria-label': 'Spec' }, code);
  const copy = el('button', { type: 'button', class: 'copy', text: 'Copy', 'aria-label': 'Copy the spec' });
  const greyNote = motion.freeFields.size > 0 ?
    el('p', { class: 'dim free-note' }, el('span', { class: 'free', text: 'Grey' }),
      ': with other values here it fails as well. The cause is in the rest.') : null;
  return el('section', { class: 'spec' }, el('h2', { text: 'Spec' }), greyNote,
    el('div', { class: 'spec-box' }, pre, copy));
}
