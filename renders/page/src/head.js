// The top of a case: what fails, how badly, and the ways out.
import { el, textButton } from './dom.js';
import { intervals, margin, seconds } from './format.js';
import { intervalsOf } from './intervals.js';

function fact(name, value) {
  return value ? el('div', {}, el('dt', { text: name }), el('dd', { text: value })) : null;
}

// The case knows it of its own motion; of one with other values the curve tells it.
function worstMargin(data, { role, curves: [curve] }) {
  if (role !== 'changed') return data.worstMargin;
  const judged = (curve?.margins ?? []).filter((one) => one !== null);
  return judged.length ? Math.min(...judged) : NaN;
}

export function factsElement(data, motion) {
  const worst = motion.worst >= 0 ? `frame ${motion.worst}, ${seconds(motion.worst, motion.rate)}` :
    'this motion does not show it';
  const length = `${motion.frameCount} at ${motion.rate} Hz, ${seconds(motion.frameCount - 1, motion.rate)}`;
  const name = motion.role === 'worst' ? 'worst margin (minimal case)' : 'worst margin';
  return el('dl', { class: 'case-facts' },
    motion.measured ? fact('measured', motion.measured) : fact(name, margin(worstMargin(data, motion), data.unit)),
    fact('worst at', worst), fact('violated in', motion.worst >= 0 ? intervals(intervalsOf(motion)) : ''),
    fact('when', motion.role === 'minimal' ? data.phase : ''), fact('needs', motion.role === 'minimal' ? data.needs : ''),
    fact('frames', length));
}

// calls: close, previous, next; the last two may be missing at the ends of the list. back: the words for close
export function headElement(data, position, calls, back = '\u2190 All failures') {
  const title = el('h1', { tabindex: '-1', class: 'case-title' },
    data.title ? el('span', { class: 'plain-name', text: data.title }) : null,
    el('span', { class: 'check', text: data.check }), ' ', el('span', { class: 'subject', text: data.subject }),
    data.character ? el('span', { class: 'character', text: ` on ${data.character}` }) : null);
  const element = el('div', { class: 'case-head' },
    textButton(back, 'Escape', calls.close, { class: 'close' }), title,
    el('span', { class: 'case-position dim', text: position || '' }),
    textButton('Previous', 'k', calls.previous, { class: 'previous', disabled: !calls.previous }),
    textButton('Next', 'j', calls.next, { class: 'next', disabled: !calls.next }),
    data.meaning ? el('p', { class: 'case-meaning dim', text: data.meaning }) : null);
  return { element, title };
}
