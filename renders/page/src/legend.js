// Says what the colours and signs in the picture mean, as far as a motion has them.
import { el } from './dom.js';

const entry = (look, text) => el('span', {}, el('span', { class: `swatch ${look}`, 'aria-hidden': 'true' }), text);

export function legendElement(motion) {
  const { joints, colliders } = motion.highlight;
  const entries = [];
  if (joints.length + colliders.length) entries.push(entry('failing', 'red: the parts that fail'));
  if (motion.ghostGlb) entries.push(entry('ghost', 'pale ghost: the motion that was to be followed'));
  if (motion.marks.some((mark) => mark.impulse)) entries.push(entry('blow', 'arrow: a blow, pointing where it pushes'));
  if (motion.balance.some(Boolean))
    entries.push(entry('balanced', 'disc: zero moment point, green while the figure is balanced, red when it is not'));
  return entries.length ? el('p', { class: 'legend stage-legend' }, ...entries) : null;
}
