// The buttons below the picture.
import { el, icon, iconButton, setPressed, textButton } from './dom.js';
import { roleName } from './format.js';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2];

function toggle(text, key, flip, hint) {
  const button = textButton(text, key, () => flip(), { class: 'toggle' });
  if (hint) button.title = `${hint} (key ${key})`;
  return button;
}

function group(name, ...children) {
  return el('div', { class: 'group', role: 'group', 'aria-label': name }, ...children);
}

export class Controls {
  // calls: step(n), first, last, toggle, worst, speed(x), loop, set(name), motion(index or 'both')
  constructor(data, calls) {
    this.calls = calls;
    this.play = textButton('', 'Space', calls.toggle, { class: 'play' });
    this.worst = textButton('Worst frame', 'w', calls.worst, { class: 'worst' });
    this.loop = toggle('Loop', 'l', calls.loop);
    const change = () => calls.speed(Number(this.speed.value));
    this.speed = el('select', { 'aria-label': 'Speed', class: 'speed', on: { change } },
      ...kSpeeds.map((speed) => el('option', { value: String(speed), text: `${speed}\u00d7` })));
    this.speed.value = '1';
    this.toggles = {
      ghost: toggle('Ghost', 'g', () => calls.set('ghost'), 'The motion that was to be followed'),
      colliders: toggle('Colliders', 'c', () => calls.set('colliders'), 'The solids that the checks measure'),
      xray: toggle('X-ray', 'x', () => calls.set('xray'), 'Failing parts shine through others'),
      follow: toggle('Follow', 'f', () => calls.set('follow'), 'The view goes along with the character'),
    };
    this.motions = this.motionButtons(data);
    this.frame = el('output', { class: 'frame-text' });
    this.live = el('p', { class: 'unseen', role: 'status', 'aria-live': 'polite' });
    // The switch between motions has its own place, next to the facts that it changes.
    this.motionGroup = this.motions.size > 1 ? group('Motion', ...this.motions.values()) : null;
    this.element = this.build();
    this.showPlaying(false);
  }

  build() {
    const { calls } = this;
    return el('div', { class: 'controls' },
      group('Playback',
        iconButton('back', 'One frame back', '\u2190', () => calls.step(-1), { 'aria-keyshortcuts': 'ArrowLeft' }),
        this.play,
        iconButton('forward', 'One frame on', '\u2192', () => calls.step(1), { 'aria-keyshortcuts': 'ArrowRight' }),
        this.worst, this.speed, this.loop),
      this.frame,
      group('Show', ...Object.values(this.toggles)),
      this.live);
  }

  motionButtons(data) {
    const buttons = new Map();
    data.motions.forEach((motion, i) =>
      buttons.set(i, textButton(roleName(motion.role), '', () => this.calls.motion(i),
        { class: 'toggle', 'data-motion': motion.role })));
    if (data.motions.some((motion) => motion.role === 'original') && data.motions.length > 1) {
      const both = toggle('Side by side', 's', () => this.calls.motion('both'),
        'Minimal and original, lined up at the worst frame');
      both.dataset.motion = 'both';
      buttons.set('both', both);
    }
    return buttons;
  }

  showPlaying(playing) {
    this.play.replaceChildren(icon(playing ? 'pause' : 'play'), playing ? 'Pause' : 'Play');
  }

  showMotion(chosen, motion) {
    for (const [which, button] of this.motions) setPressed(button, which === chosen);
    this.worst.disabled = motion.worst < 0;
    this.toggles.ghost.hidden = !motion.ghostGlb;
    this.toggles.colliders.hidden = motion.colliders.length === 0;
  }

  showToggles(values) {
    for (const [name, button] of Object.entries(this.toggles)) setPressed(button, values[name]);
  }

  showLoop(on) {
    setPressed(this.loop, on);
  }

  showFrame(text) {
    this.frame.textContent = text;
  }

  // Spoken when the motion stands still, not at each frame.
  tell(text) {
    clearTimeout(this.telling);
    this.telling = setTimeout(() => { this.live.textContent = text; }, 300);
  }
}
