// When which action moved which part, as bars; blows as ticks.
import { el } from './dom.js';

// Bars of one part that overlap go below each other.
export function lanesOf(spans) {
  const rows = new Map();
  for (const span of [...spans].sort((a, b) => a.first - b.first || a.last - b.last)) {
    const name = span.slot || span.name;
    if (!rows.has(name)) rows.set(name, []);
    const lanes = rows.get(name);
    let lane = lanes.find((bars) => bars.at(-1).last < span.first);
    if (!lane) lanes.push(lane = []);
    lane.push(span);
  }
  return [...rows].flatMap(([name, lanes]) => lanes.map((bars, i) => ({ name: i === 0 ? name : '', bars })));
}

function told(span) {
  const where = [span.slot && `on ${span.slot}`, span.clip && `clip ${span.clip}`,
    span.sequence && `sequence ${span.sequence}`].filter(Boolean).join(', ');
  return `${span.action || span.name}${where ? ` (${where})` : ''}: frames ${span.first}\u2013${span.last}`;
}

const percent = (frames, count) => `${100 * frames / count}%`;

function bar(span, count) {
  const element = el('li', { class: 'span-bar', text: span.action || span.name, title: told(span) });
  element.append(el('span', { class: 'unseen', text: `, frames ${span.first} to ${span.last}` }));
  element.style.left = percent(span.first, count);
  element.style.width = percent(span.last - span.first + 1, count);
  return element;
}

// A tick has the track on the side where more of it is left for its text.
function tick(mark, count) {
  const text = mark.text || mark.kind;
  const element = el('li', { class: 'tick' },
    el('span', { class: 'tick-text', text, title: `${text}: frame ${mark.frame}` }));
  const leftward = 2 * mark.frame >= count;
  element.classList.toggle('leftward', leftward);
  element.style[leftward ? 'right' : 'left'] = percent(leftward ? count - mark.frame - 0.5 : mark.frame + 0.5, count);
  return element;
}

function row(name, items, look) {
  return el('div', { class: `row span-row ${look}` }, el('span', { class: 'name', text: name, title: name }),
    el('ul', { class: 'track', 'aria-label': name || 'more' }, ...items));
}

// Null where nothing is to be shown.
export function spansElement(motion) {
  const count = motion.frameCount;
  const rows = lanesOf(motion.spans).map(({ name, bars }) => row(name, bars.map((span) => bar(span, count)), ''));
  if (motion.marks.length)
    rows.push(row('blows and events', motion.marks.map((mark) => tick(mark, count)), 'ticks'));
  return rows.length ? el('div', { class: 'spans' }, el('h2', { text: 'Actions' }), ...rows) : null;
}
