// One open case: makes the parts, and tells all of them when the frame or the motion changes.
import { readCase } from './case_data.js';
import { Controls } from './controls.js';
import { el } from './dom.js';
import { startEngine } from './engine.js';
import { margin, roleName, seconds } from './format.js';
import { factsElement, headElement } from './head.js';
import { listenForKeys } from './keys.js';
import { legendElement } from './legend.js';
import { notJudgedElement, unmetElement } from './notes.js';
import { Player } from './player.js';
import { specElement } from './spec_view.js';
import { Stage } from './stage.js';
import { nearestTile, readStrip } from './strip_view.js';
import { Timeline } from './timeline.js';
import { Trial } from './trial.js';

const kSlow = 45;  // Milliseconds per picture while playing.

export class CaseView {
  constructor(container, data, options) {
    this.data = readCase(data);
    this.options = options;
    this.container = container;
    this.both = false;
    this.stage = new Stage({ asInStrip: () => this.lookAsStrip() });
    this.player = new Player({ frame: () => this.showFrame(), playing: (on) => this.showPlaying(on) });
    this.controls = new Controls(this.data, this.calls());
    this.element = this.build();
    container.replaceChildren(this.element);
    this.stopKeys = listenForKeys(this.keys());
    this.controls.showToggles(this.stage.toggles);
    this.controls.showLoop(false);
    this.chooseMotion(0, options.frame);
    this.title.focus({ preventScroll: true });
  }

  build() {
    const { options } = this;
    const head = headElement(this.data, options.position, {
      close: () => this.close(), previous: options.onPrevious, next: options.onNext,
    }, options.back);
    this.title = head.title;
    this.facts = el('div', { class: 'facts-place' });
    this.legend = el('div', { class: 'legend-place' });
    this.below = el('div', { class: 'below' });
    if (options.loadEngine && this.data.motions[0].spec !== null) this.trial = this.makeTrial();
    return el('div', { class: 'case' }, head.element,
      el('div', { class: 'facts-row' }, this.facts, this.controls.motionGroup), this.stage.frame,
      this.legend, this.controls.element, this.trial?.element ?? '', this.below);
  }

  // It stands outside of what each new motion replaces, so that a field keeps its focus.
  makeTrial() {
    return new Trial(this.data, {
      engine: () => startEngine(this.options.loadEngine),
      show: (motion) => this.show('changed', motion, null, this.player.frame, true),
      back: () => this.chooseMotion(0, this.player.frame),
    });
  }

  calls() {
    const player = () => this.player;
    return {
      step: (count) => player().step(count),
      toggle: () => player().toggle(),
      worst: () => this.toWorst(),
      speed: (speed) => { player().speed = speed; },
      loop: () => { player().loop = !player().loop; this.controls.showLoop(player().loop); },
      set: (name) => {
        this.stage.set(name, !this.stage.toggles[name]);
        this.controls.showToggles(this.stage.toggles);
      },
      motion: (which) => this.chooseMotion(which),
    };
  }

  keys() {
    const calls = this.calls();
    const step = (sign) => (event) => calls.step(sign * (event.shiftKey ? 10 : 1));
    return {
      ' ': calls.toggle, ArrowLeft: step(-1), ArrowRight: step(1), w: calls.worst, l: calls.loop,
      Home: () => calls.step(-this.motion.frameCount), End: () => calls.step(this.motion.frameCount),
      g: () => this.motion.ghostGlb && calls.set('ghost'),
      c: () => this.motion.colliders.length && calls.set('colliders'),
      v: () => this.lookAsStrip(), x: () => calls.set('xray'), f: () => calls.set('follow'),
      s: () => this.controls.motions.has('both') && this.chooseMotion(this.both ? 0 : 'both'),
      j: () => this.options.onNext?.(), k: () => this.options.onPrevious?.(), Escape: () => this.close(),
    };
  }

  // `frame` missing: its worst one.
  chooseMotion(which, frame) {
    const { motions } = this.data;
    const both = which === 'both';
    this.show(which, motions[both ? 0 : which], both ? motions.find(({ role }) => role === 'original') : null, frame);
  }

  show(which, motion, other, frame, keepView = false) {
    this.player.pause();
    this.both = which === 'both';
    this.motion = motion;
    this.other = other;
    this.facts.replaceChildren(factsElement(this.data, this.motion));
    this.controls.showMotion(which, this.motion);
    this.showBelow();
    this.loading = true;
    this.player.setMotion(this.motion.frameCount, this.motion.rate, frame ?? Math.max(0, this.motion.worst));
    this.loading = false;
    this.stage.stripButton.hidden = !this.hasStrip();
    const shown = [this.motion, this.other].filter(Boolean);
    this.stage.frames = this.frames();
    this.loaded = this.stage.setMotions(shown, keepView).then(() => { this.element.dataset.ready = String(which); });
  }

  showBelow() {
    this.timeline?.dispose();
    this.timeline = new Timeline(this.motion, { seek: (frame) => { this.player.pause(); this.player.seek(frame); } });
    this.legend.replaceChildren(...[legendElement(this.motion)].filter(Boolean));
    const rest = [this.timeline.others, unmetElement(this.motion), notJudgedElement(this.motion), this.commandElement(),
      specElement(this.motion), this.pictureElement()];
    this.below.replaceChildren(...[this.timeline.element, ...rest].filter(Boolean));
  }

  commandElement() {
    const { command } = this.options;
    if (!command || this.motion.role === 'changed') return null;
    return el('section', { class: 'again' }, el('h2', { text: 'See it again' }),
      el('div', { class: 'command' }, el('code', { text: command }),
        el('button', { type: 'button', class: 'copy', text: 'Copy', 'aria-label': 'Copy the replay command' })));
  }

  pictureElement() {
    const { picture } = this.options;
    if (!picture?.src) return null;
    return el('details', { class: 'picture' }, el('summary', { text: 'Film strip' }),
      el('div', { class: 'strip' }, el('img', { src: picture.src, alt: picture.alt || 'Film strip' })));
  }

  // The frame of each pane. The original is lined up so that both are at their worst at once.
  frames() {
    const { frame } = this.player;
    if (!this.other) return [frame];
    const lined = this.motion.worst >= 0 && this.other.worst >= 0;
    const time = (frame - (lined ? this.motion.worst : 0)) / this.motion.rate;
    const other = Math.round(time * this.other.rate) + (lined ? this.other.worst : 0);
    return [frame, Math.max(0, Math.min(this.other.frameCount - 1, other))];
  }

  showFrame() {
    if (!this.timeline) return;
    const { frame } = this.player;
    const frames = this.frames();
    // Once slow, quick until it stands still: a picture that keeps changing its sharpness is worse.
    const { playing, lag } = this.player;
    this.quick = playing && (this.quick || lag > kSlow);
    this.stage.setQuick(this.quick);
    if (!this.loading) this.stage.show(frames);
    this.timeline.setFrame(frame);
    const curve = this.motion.curves[0];
    const value = curve?.margins[frame] ?? null;
    const told = value === null ? '' : `, margin ${margin(value, curve.unit)}`;
    const text = `Frame ${frame} / ${this.motion.frameCount - 1}, ${seconds(frame, this.motion.rate)}${told}`;
    this.controls.showFrame(text);
    this.controls.frame.classList.toggle('violated', value !== null && value < 0);
    this.stage.describe(`The motion as a picture: ${text}`, this.paneLabels(frames));
    if (this.player.playing) return;
    this.controls.tell(text);
    this.options.onFrame?.(frame);
  }

  paneLabels(frames) {
    const balance = this.motion.balance[frames[0]];
    const zero = balance && balance.margin !== null ? `zero moment point: ${margin(balance.margin, 'm')}` : '';
    if (!this.other) return [[roleName(this.motion.role), zero].filter(Boolean).join(', ')];
    return [this.motion, this.other].map((motion, i) => `${roleName(motion.role)}, frame ${frames[i]}`);
  }

  showPlaying(playing) {
    this.controls?.showPlaying(playing);
    // Also makes the picture sharp again.
    if (!playing && this.timeline) this.showFrame();
  }

  // The strip is of the minimal motion alone.
  hasStrip() {
    return Boolean(this.options.stripViews) && this.motion === this.data.motions[0] && !this.stage.flat;
  }

  async lookAsStrip() {
    if (!this.hasStrip()) return;
    try {
      this.tiles ??= readStrip(await this.options.stripViews());
      if (this.hasStrip() && this.stage.drawing) this.stage.lookAs(nearestTile(this.tiles, this.player.frame));
    } catch (error) {
      this.stage.say(error.message);
    }
  }

  toWorst() {
    if (this.motion.worst < 0) return;
    this.player.pause();
    this.player.seek(this.motion.worst);
  }

  // Closes the case without telling the page, because another case takes its place.
  dispose() {
    this.player.pause();
    this.stopKeys();
    clearTimeout(this.controls.telling);
    this.trial?.dispose();
    this.timeline.dispose();
    this.stage.dispose();
    this.element.remove();
  }

  close() {
    this.dispose();
    this.options.onClose?.();
  }
}
