// Margins of the take up to the clock, and what acted when: a heat map of all curves, one of them as a plot, spans.
import { Axis, seekByPointer } from '../src/axis.js';
import { CurvePlot } from '../src/curve_plot.js';
import { el } from '../src/dom.js';
import { HeatMap, curveName } from '../src/heat_map.js';
import { spansElement } from '../src/spans.js';
import { onThemeChange, theme } from '../src/theme.js';
import { choice } from './fields.js';

const kAutomatic = '';
const kRedraw_ms = 120;  // Plots are drawn anew at most this often.

function lowestShare(curve, end) {
  let low = Infinity;
  for (let at = 0; at < Math.min(end, curve.margins.length); ++at)
    if (curve.margins[at] !== null) low = Math.min(low, curve.margins[at] / curve.scale);
  return low;
}

export class LiveTimeline {
  // calls: look(frame)
  constructor(calls) {
    this.calls = calls;
    this.frame = 0;
    this.end = 0;
    this.chosen = kAutomatic;
    this.axis = new Axis(1);
    this.frameAt = (clientX) => Math.min(Math.max(0, this.end - 1),
      this.axis.frameAt(clientX - this.element.getBoundingClientRect().left - this.axis.gutter));
    this.parts = { frameAt: this.frameAt, seek: calls.look };
    this.modes = el('div', { class: 'row-of-fields' });
    this.curve = choice('Curve', [[kAutomatic, 'nearest to its limit so far']], kAutomatic, (name) => {
      this.chosen = name;
      this.showCurve();
    });
    this.heatPlace = el('div');
    this.plotPlace = el('div', { class: 'curves' });
    this.spansPlace = el('div');
    this.head = el('div', { class: 'playhead', 'aria-hidden': 'true' });
    this.note = el('p', { class: 'dim', text: 'No margins yet.' });
    this.element = el('section', { class: 'timeline', 'aria-label': 'Margins over time' },
      this.heatPlace, this.plotPlace, this.spansPlace, this.head);
    this.whole = el('div', {}, el('div', { class: 'row-of-fields' }, this.modes, this.curve.element), this.note,
      this.element);
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.element);
    onThemeChange(() => { this.width = 0; this.resize(); });
  }

  // A take begins.
  begin(tracks) {
    this.tracks = tracks;
    this.axis = new Axis(tracks.frameCount);
    this.width = 0;
    this.end = 0;
    this.names = '';
    this.heat = null;
    this.heatPlace.replaceChildren();
    if (!tracks.modes.includes(this.mode)) this.mode = tracks.modes[0];
    this.modes.replaceChildren();
    if (tracks.modes.length > 1) {
      this.modes.append(choice('Margins of', tracks.modes.map((mode) => [mode, mode]), this.mode, (mode) => {
        this.mode = mode;
        this.update();
        this.updateSpans();
      }).element);
    }
    this.update();
    this.updateSpans();
    this.resize();
  }

  curves() {
    return this.tracks?.of.get(this.mode)?.curves ?? [];
  }

  // Margins changed.
  update() {
    const curves = this.curves();
    const names = JSON.stringify(curves.map(curveName));
    this.note.hidden = curves.length > 0;
    if (names !== this.names) this.rename(curves);
    this.names = names;
    this.heat?.setCurves(curves);
    this.heat?.setEnd(this.end);
    this.showCurve();
  }

  rename(curves) {
    this.curve.set([[kAutomatic, 'nearest to its limit so far'],
      ...curves.map((curve) => [curveName(curve), curveName(curve)])], this.chosen);
    if (curves.length && !this.heat) {
      this.heat = new HeatMap(curves, this.parts);
      this.heat.setFrame(this.frame);
      this.heatPlace.replaceChildren(this.heat.element);
      this.width = 0;
      this.resize();
    } else if (!curves.length) {
      this.heat = null;
      this.heatPlace.replaceChildren();
    }
  }

  shownCurve() {
    const curves = this.curves();
    const named = curves.find((curve) => curveName(curve) === this.chosen);
    if (named || curves.length === 0) return named ?? null;
    const shares = curves.map((curve) => lowestShare(curve, this.end));
    return curves[shares.indexOf(Math.min(...shares))];
  }

  showCurve() {
    this.drawn = performance.now();
    const curve = this.shownCurve();
    const name = curve ? curveName(curve) : '';
    if (this.plot && (name !== this.plotName || this.plot.motion.frameCount !== this.axis.frameCount)) {
      this.plot.destroy();
      this.plot = null;
    }
    this.plotName = name;
    if (!curve) return;
    if (this.plot) {
      this.plot.update(curve, this.end);
    } else {
      this.plot = new CurvePlot(curve, { frameCount: this.axis.frameCount, curves: [], first: -1, last: -1 }, false,
        this.parts);
      this.plot.end = this.end;
      this.plotPlace.replaceChildren(this.plot.element);
      if (this.width) this.plot.resize(this.axis, theme());
    }
    this.plot.setFrame(this.frame);
  }

  updateSpans() {
    const track = this.tracks?.of.get(this.mode);
    const spans = track ? spansElement({ ...track, frameCount: this.axis.frameCount }) : null;
    for (const row of spans?.querySelectorAll('.track') ?? []) seekByPointer(row, this.frameAt, this.calls.look);
    this.spansPlace.replaceChildren(...(spans ? [spans] : []));
  }

  // `now`: the clock's frame; `frame`: the one that is looked at.
  setFrame(frame, now) {
    this.frame = frame;
    if (now + 1 !== this.end) {
      this.end = now + 1;
      this.heat?.setEnd(this.end);
      if (performance.now() - this.drawn > kRedraw_ms) this.showCurve();
      else this.later();
    }
    this.heat?.setFrame(frame);
    this.plot?.setFrame(frame);
    this.placeHead();
  }

  // The last of many changes is drawn, too.
  later() {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.showCurve(), kRedraw_ms);
  }

  resize() {
    const width = this.element.clientWidth;
    if (width === 0 || width === this.width) return;
    this.width = width;
    const gutter = width < 620 ? 76 : width < 1000 ? 176 : 220;
    this.axis.resize(gutter, width);
    this.element.style.setProperty('--gutter', `${gutter}px`);
    this.heat?.resize(this.axis, theme());
    this.plot?.resize(this.axis, theme());
    this.placeHead();
  }

  placeHead() {
    this.head.style.transform = `translateX(${this.axis.gutter + this.axis.x(this.frame)}px)`;
  }
}
