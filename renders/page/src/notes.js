// Lists what a case's failure does not show: requests that were not met, and checks that could not judge.
import { el } from './dom.js';
import { interval } from './format.js';

function section(look, title, intro, items) {
  return el('section', { class: look }, el('h2', { text: title }), el('p', { class: 'dim', text: intro }),
    el('ul', {}, ...items.map((text) => el('li', { text }))));
}

export function unmetElement(motion) {
  if (motion.unmet.length === 0) return null;
  const texts = motion.unmet.map(({ action, slot, why, first, last }) =>
    [`${action}${slot ? ` (${slot})` : ''}`, interval(first, last), why].filter(Boolean).join(', '));
  const intro = 'The generator came as near as it could. These are notes, not failures.';
  return section('unmet', 'Requests that were not met', intro, texts);
}

export function notJudgedElement(motion) {
  if (motion.notJudged.length === 0) return null;
  return section('not-judged', 'What was not judged', 'The verdict on this motion says nothing about these checks.',
    motion.notJudged.map(({ check, title, reason }) =>
      `${title && title !== check ? `${title} (${check})` : check}${reason ? `: ${reason}` : ''}`));
}
