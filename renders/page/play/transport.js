// The buttons below the picture: the session's clock, and what is shown.
import { el, icon, iconButton, setPressed, textButton } from '../src/dom.js';

function toggle(text, key, flip, hint) {
  return textButton(text, key, flip, { class: 'toggle', title: `${hint}${key ? ` (key ${key})` : ''}` });
}

export class Transport {
  // calls: toggle(), step(n), look(n), now(), restart(), set(name), hand()
  constructor(calls) {
    this.play = textButton('', 'Space', calls.toggle, { class: 'play' });
    this.now = textButton('Back to now', 'n', calls.now, { class: 'now' });
    this.toggles = {
      hand: toggle('Aim and push', 'h', calls.hand, 'In the picture a click aims, and a drag on the body pushes'),
      colliders: toggle('Colliders', 'c', () => calls.set('colliders'), 'The solids that the checks measure'),
      follow: toggle('Follow', 'f', () => calls.set('follow'), 'The view goes along with the character'),
    };
    this.restart = textButton('Restart', 'Home', calls.restart);
    this.forward = iconButton('forward', 'One frame on', '\u2192', () => calls.step(1),
      { 'aria-keyshortcuts': 'ArrowRight' });
    this.frame = el('output', { class: 'frame-text' });
    this.element = el('div', { class: 'controls' },
      el('div', { class: 'group', role: 'group', 'aria-label': 'Clock' },
        this.restart,
        iconButton('back', 'Look one frame back', '\u2190', () => calls.look(-1), { 'aria-keyshortcuts': 'ArrowLeft' }),
        this.play,
        this.forward,
        this.now),
      this.frame,
      el('div', { class: 'group', role: 'group', 'aria-label': 'Picture' }, ...Object.values(this.toggles)));
    this.showPlaying(false);
    this.showLooking(false);
    this.showOpen(false);
  }

  // The clock is the session's: without one, the buttons that move it cannot be pressed.
  showOpen(open) {
    for (const button of [this.restart, this.play, this.forward]) button.disabled = !open;
  }

  showPlaying(playing) {
    if (this.playing === playing) return;
    this.playing = playing;
    this.play.replaceChildren(icon(playing ? 'pause' : 'play'), playing ? 'Pause' : 'Play');
  }

  showLooking(looking) {
    this.now.disabled = !looking;
  }

  showToggles(values) {
    for (const [name, button] of Object.entries(this.toggles)) setPressed(button, values[name]);
  }

  show(text) {
    if (this.frame.textContent !== text) this.frame.textContent = text;
  }
}
