// The playground: a session's stream on one side, forms that send commands on the other.
import { sentence } from '../src/api.js';
import { el } from '../src/dom.js';
import { listenForKeys } from '../src/keys.js';
import { seconds } from '../src/format.js';
import { Stage } from '../src/stage.js';
import { CharacterPanel } from './character_panel.js';
import { Clock } from './clock.js';
import { Findings } from './findings.js';
import { HandPanel } from './hand_panel.js';
import { LivePane } from './live_pane.js';
import { LiveTimeline } from './live_timeline.js';
import { PointerTool } from './pointer.js';
import { QueuePanel } from './queue_panel.js';
import { Session, problemOf } from './session.js';
import { SessionPanel } from './session_panel.js';
import { emptySpec } from './spec_edit.js';
import { Tracks } from './tracks.js';
import { Transport } from './transport.js';
import { ModesField, WorldPanel } from './world_panel.js';

const kLost = 'The browser took the 3-D picture away. Load this page again.';
const kConnectionLost = 'The connection to the server is lost; trying again. What was received is still shown.';
const kFindings_ms = 100;
const kSlow_ms = 45;  // From picture to picture.

export class PlayView {
  constructor(container, catalogue) {
    this.catalogue = catalogue;
    this.writes = !catalogue.read_only && catalogue.corpus !== false;
    this.clock = new Clock();
    this.tracks = new Tracks();
    this.looking = null;  // The frame that is looked at, while the clock is elsewhere.
    this.frame = -1;
    this.targets = new Map();
    this.hand = true;
    this.session = new Session({
      state: (state) => this.showState(state), event: (kind, data) => this.take(kind, data),
      connection: (state) => this.showConnection(state), waiting: (text) => this.say(text),
      again: (text) => { this.restored = text; },
    });
    this.build(container);
    this.stopKeys = listenForKeys(this.keys());
    requestAnimationFrame(() => this.tick());
  }

  build(container) {
    this.stage = new Stage({ load: LivePane.load, lost: kLost });
    this.stage.toggles.ghost = false;
    this.pointer = new PointerTool(this.stage, {
      enabled: () => this.hand, aim: (point) => this.handPanel.aim(point), push: (push) => this.handPanel.push(push),
      pushing: (text) => { this.pushing.textContent = text; },
      picked: (joint, point) => this.handPanel.pick(joint, point),
      strength: () => this.handPanel.strength.value() ?? 150,
      surface: () => this.handPanel.means.value() === 'surface',
    });
    this.pushing = el('p', { class: 'pushing', 'aria-hidden': 'true' });
    this.stage.element.append(this.pushing);
    this.stage.frame.id = 'picture';
    this.transport = new Transport(this.transportCalls());
    this.timeline = new LiveTimeline({ look: (frame) => this.look(frame) });
    this.findings = new Findings(this);
    this.modes = new ModesField(this);
    this.handPanel = new HandPanel(this);
    this.queue = new QueuePanel(this);
    this.panels = [this.modes, this.queue, this.handPanel, new CharacterPanel(this), new WorldPanel(this),
      new SessionPanel(this)];
    this.note = el('p', { class: 'note', role: 'status' });
    this.alarm = el('p', { class: 'problem', role: 'alert' });
    this.alarm.hidden = true;
    this.title = el('p', { class: 'about dim' });
    this.element = el('div', { class: 'case playground' },
      el('header', { class: 'top' }, el('h1', { text: 'Playground' }), this.title,
        this.catalogue.corpus === false ? null :
          el('nav', { 'aria-label': 'Pages' }, el('a', { href: '/', text: 'Report' }))),
      el('main', {}, el('div', { class: 'seen' }, this.stage.frame, this.transport.element, this.alarm, this.note,
        this.findings.element, this.timeline.whole),
      el('div', { class: 'side' }, ...this.panels.map(({ element }) => element))));
    container.append(this.element);
    this.transport.showToggles({ ...this.stage.toggles, hand: true });
    this.touch();
  }

  transportCalls() {
    return {
      toggle: () => this.toggle(), step: (count) => this.step(count),
      look: (way) => this.look((this.shown() ?? 0) + way),
      now: () => this.look(null), restart: () => this.restart(),
      set: (name) => { this.stage.set(name, !this.stage.toggles[name]); this.showToggles(); },
      hand: () => { this.hand = !this.hand; this.showToggles(); this.touch(); },
    };
  }

  // Something else takes the place and the keys of the playground.
  leave() {
    this.element.hidden = true;
    this.stopKeys();
  }

  comeBack() {
    this.element.hidden = false;
    this.stopKeys = listenForKeys(this.keys());
  }

  showToggles() {
    this.transport.showToggles({ ...this.stage.toggles, hand: this.hand });
  }

  // A finger that pushes must not scroll the page.
  touch() {
    this.stage.drawing.canvas.style.touchAction = this.hand ? 'none' : 'pan-y';
  }

  keys() {
    const calls = this.transportCalls();
    return {
      ' ': calls.toggle, ArrowRight: (event) => calls.step(event.shiftKey ? 10 : 1),
      ArrowLeft: (event) => calls.look(event.shiftKey ? -10 : -1), Home: calls.restart, n: calls.now, h: calls.hand,
      c: () => calls.set('colliders'), f: () => calls.set('follow'),
    };
  }

  // ---- words

  say(text) {
    this.note.textContent = text;
  }

  fail(text) {
    this.alarm.hidden = !text;
    this.alarm.textContent = text;
  }

  // Runs `work`; an error is shown as its sentence. False then.
  async guard(work) {
    try {
      await work();
      if (!this.disconnected) this.fail('');
      return true;
    } catch (error) {
      this.fail(sentence(error));
      return false;
    }
  }

  showConnection(state) {
    const lost = state === 'lost';
    if (lost === Boolean(this.disconnected)) return;
    this.disconnected = lost;
    this.fail(lost ? kConnectionLost : '');
    if (lost) return;
    this.say(this.restored || 'Connected.');
    this.restored = '';
  }

  // ---- commands

  // A key may come before the session is there.
  command(name, body) {
    if (!this.session.state) return Promise.resolve(false);
    this.look(null);
    return this.guard(() => this.session.command(name, body));
  }

  change(body) {
    return this.command('change', body);
  }

  toggle() {
    this.look(null);
    this.command('clock', { play: !this.clock.playing });
  }

  // Forward from a frame that is looked at goes on looking, up to the clock.
  step(count) {
    if (this.looking !== null) this.look(this.looking + count);
    else this.command('clock', { step: count });
  }

  restart() {
    this.command('clock', { restart: true });
  }

  begin(spec, modes) {
    this.targets.clear();
    return this.guard(() => this.session.begin({ spec, modes }));
  }

  async startOver() {
    const { spec, modes } = this.session.state;
    if (await this.begin(emptySpec(spec.character?.name), modes)) this.command('clock', { play: true });
  }

  // ---- what the server says

  showState(state) {
    sessionStorage.setItem('session', state.session);
    this.transport.showOpen(true);
    for (const one of this.panels) one.update(state);
  }

  take(kind, data) {
    try {
      this.takers()[kind](data);
    } catch (error) {
      this.fail(`What the server sent cannot be shown: ${error.message}.`);
    }
  }

  takers() {
    return {
      take: (data) => this.beginTake(data),
      clock: (data) => {
        if (data.take !== this.tracks.take) return;
        this.clock.set(data, performance.now());
        this.transport.showPlaying(this.clock.playing);
      },
      frames: (data) => { this.tracks.addFrames(data); this.stale = true; },
      margins: (data) => {
        this.tracks.addMargins(data);
        if (data.mode === this.timeline.mode) this.timeline.update();
        this.judged = 0;
      },
      spans: (data) => {
        this.tracks.addSpans(data);
        if (data.mode === this.timeline.mode) this.timeline.updateSpans();
        for (const pane of this.stage.panes)
          if (pane.mode === data.mode) pane.setMarks(this.tracks.of.get(pane.mode)?.marks ?? []);
        this.stale = true;
      },
      problem: (data) => this.fail(sentence(problemOf(data))),
    };
  }

  beginTake(data) {
    const again = data.take === this.tracks.take;
    this.tracks.begin(data);
    this.clock.begin(this.tracks.rate, this.tracks.frameCount);
    this.looking = null;
    this.frame = -1;
    if (!again) this.targets.clear();
    this.findings.begin(this.tracks.take);
    this.timeline.begin(this.tracks);
    this.session.refresh().catch(() => {});
    this.guard(() => this.loadModel());
  }

  // Surroundings change with takes, too, so each take asks; the picture is built anew only where something differs.
  async loadModel() {
    const take = this.tracks.take;
    const model = await this.session.model();
    if (take !== this.tracks.take) return;
    const key = JSON.stringify([model, this.tracks.modes]);
    if (key === this.modelKey) { this.stale = true; return; }
    const sameCharacter = this.model?.glb === model.glb;
    this.modelKey = key;
    this.model = model;
    for (const one of this.panels) if (this.session.state) one.update(this.session.state);
    const views = this.tracks.modes.map((mode) => ({ mode, model, tracks: this.tracks }));
    this.stage.frames = views.map(() => this.shown() ?? 0);
    await this.stage.setMotions(views, sameCharacter);
    this.decorate();
    this.stage.element.dataset.ready = String(model.model);
  }

  // Panes are made anew with each model and change of colours.
  decorate() {
    for (const pane of this.stage.panes) {
      pane.setTargets(this.targets);
      pane.setMarks(this.tracks.of.get(pane.mode)?.marks ?? []);
    }
    this.decorated = this.stage.panes[0];
    this.stale = true;
  }

  showTarget(slot, point, label) {
    this.targets.set(slot, point);
    for (const pane of this.stage.panes) pane.setTargets(this.targets);
    this.say(`${label}: ${point.map((value) => value.toFixed(2)).join(', ')} m`);
    this.stage.invalidate();
  }

  stance() {
    return this.stage.panes[0]?.stance() ?? { x: 0, z: 0, heading: 0 };
  }

  // ---- time

  now() {
    return Math.min(this.clock.frame(performance.now()), Math.max(0, this.tracks.last()));
  }

  shown() {
    return this.looking ?? this.now();
  }

  // A frame that was played already; null: back to the clock.
  look(frame) {
    const { playing } = this.clock;
    this.looking = frame === null ? null : Math.max(0, Math.min(this.now(), frame));
    if (this.looking !== null && playing) this.guard(() => this.session.command('clock', { play: false }));
    this.transport.showLooking(this.looking !== null);
    this.stale = true;
    if (this.looking !== null) this.fetchGap();
  }

  // A page that came later has not been sent what was played before.
  async fetchGap() {
    const gap = this.tracks.gap(this.looking);
    if (!gap || this.fetching) return;
    const { take } = this.tracks;
    this.fetching = true;
    const done = await this.guard(async () => {
      const frames = await this.session.frames(gap.mode, gap.from, gap.count);
      if (take === this.tracks.take) this.tracks.fill(gap.mode, gap.from, frames);
    });
    this.fetching = false;
    this.stale = true;
    if (done && this.looking !== null && this.tracks.gap(this.looking)?.mode !== gap.mode) this.fetchGap();
  }

  tick(time = 0) {
    requestAnimationFrame((next) => this.tick(next));
    this.watchSpeed(time);
    if (this.stage.panes[0] !== this.decorated && this.stage.panes.length) this.decorate();
    const frame = this.shown();
    if (frame !== this.frame || this.stale) this.showFrame(frame);
    if (performance.now() - (this.judged ?? 0) > kFindings_ms && this.tracks.of.size) {
      this.judged = performance.now();
      this.findings.update(this.tracks, this.now());
    }
  }

  // Fewer pixels, once a machine was too slow, until the clock stands still.
  watchSpeed(time) {
    this.lag = (this.lag ?? 0) + 0.1 * (Math.min(500, time - (this.ticked ?? time)) - (this.lag ?? 0));
    this.ticked = time;
    this.quick = this.clock.playing && (this.quick || this.lag > kSlow_ms);
    this.stage.setQuick(Boolean(this.quick));
  }

  showFrame(frame) {
    this.frame = frame;
    this.stale = false;
    const now = this.now();
    this.stage.show(this.stage.panes.map(() => frame));
    this.timeline.setFrame(frame, now);
    this.queue.setFrame(now);
    const { take, rate, frameCount, modes } = this.tracks;
    const looking = this.looking === null ? '' : `, looking back from frame ${now}`;
    const text = `Take ${take}, frame ${frame} / ${frameCount - 1}, ${seconds(frame, rate)}${looking}`;
    this.transport.show(text);
    this.stage.describe(`The character as a picture: ${text}`, modes);
  }
}
