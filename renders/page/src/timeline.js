// Everything that has frames from left to right: scrub bar, heat map, curves, spans; one play head over all of it.
import { Axis, seekByPointer } from './axis.js';
import { CurvePlot } from './curve_plot.js';
import { el } from './dom.js';
import { interval, margin, seconds } from './format.js';
import { intervalsOf } from './intervals.js';
import { HeatMap, curveName } from './heat_map.js';
import { spansElement } from './spans.js';
import { onThemeChange, theme } from './theme.js';

const kThumb = 18;  // Width of the scrub bar's handle, as in viewer.css.

export class Timeline {
  // calls: seek(frame)
  constructor(motion, calls) {
    this.motion = motion;
    this.calls = calls;
    this.axis = new Axis(motion.frameCount);
    this.frameAt = (clientX) =>
      this.axis.frameAt(clientX - this.element.getBoundingClientRect().left - this.axis.gutter);
    this.parts = { frameAt: this.frameAt, seek: calls.seek };
    this.plots = new Map();
    this.build();
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.element);
    this.stopTheme = onThemeChange(() => { this.width = 0; this.resize(); });
  }

  build() {
    const { motion, calls } = this;
    this.scrub = el('input', {
      type: 'range', class: 'scrub', min: '0', max: String(motion.frameCount - 1), step: '1', value: '0',
      'aria-label': 'Frame', on: { input: () => this.calls.seek(Number(this.scrub.value)) },
    });
    this.told = el('span', { class: 'name scrub-told' });
    this.head = el('div', { class: 'playhead', 'aria-hidden': 'true' });
    this.heat = motion.curves.length ? new HeatMap(motion.curves, this.parts) : null;
    this.spans = spansElement(motion);
    for (const track of this.spans?.querySelectorAll('.track') ?? []) seekByPointer(track, this.frameAt, calls.seek);
    this.curves = el('div', { class: 'curves' });
    if (motion.curves.length) this.addPlot(motion.curves[0], false);
    else this.curves.append(el('p', { class: 'dim', text: 'No margins were recorded for this motion.' }));
    this.element = el('section', { class: 'timeline', 'aria-label': 'Over time' },
      el('div', { class: 'row' }, el('span'), el('div', { class: 'track' }, ...this.violations())),
      el('div', { class: 'row scrub-row' }, this.told, el('div', { class: 'track' }, this.scrub)),
      this.heat?.element, this.curves, this.spans, this.head);
    this.others = this.otherCurves();
  }

  // The frames of each violation, marked right above the scrub bar.
  violations() {
    const { frameCount } = this.motion;
    return intervalsOf(this.motion).map(({ first, last }) => {
      const bar = el('div', { class: 'violation', title: `Violated in ${interval(first, last)}` });
      bar.style.left = `${100 * first / frameCount}%`;
      bar.style.width = `${100 * (last - first + 1) / frameCount}%`;
      return bar;
    });
  }

  otherCurves() {
    const others = this.motion.curves.slice(1);
    if (others.length === 0) return null;
    const boxes = others.map((curve) => {
      const box = el('input', { type: 'checkbox', on: { change: () => this.choose(curve, box.checked) } });
      const lowest = curve.margins.reduce((low, value) => (value === null ? low : Math.min(low, value)), Infinity);
      return el('li', {}, el('label', {}, box, el('span', { text: curveName(curve) }),
        el('span', { class: 'dim', text: Number.isFinite(lowest) ? `lowest ${margin(lowest, curve.unit)}` : '' })));
    });
    return el('details', { class: 'others', open: true }, el('summary', { text: 'Other curves near their limits' }),
      el('ul', {}, ...boxes));
  }

  choose(curve, on) {
    if (on) this.addPlot(curve, true);
    else { this.plots.get(curve).destroy(); this.plots.delete(curve); }
  }

  addPlot(curve, small) {
    const plot = new CurvePlot(curve, this.motion, small, this.parts);
    this.plots.set(curve, plot);
    this.curves.append(plot.element);
    if (this.width) plot.resize(this.axis, theme());
    plot.setFrame(this.frame ?? 0);
  }

  resize() {
    const width = this.element.clientWidth;
    if (width === 0 || width === this.width) return;
    this.width = width;
    const gutter = width < 620 ? 76 : width < 1000 ? 196 : 248;
    this.axis.resize(gutter, width);
    this.element.style.setProperty('--gutter', `${gutter}px`);
    // The handle's middle has to be over the column of its frame.
    const half = this.axis.column() / 2;
    this.scrub.style.marginLeft = `${half - kThumb / 2}px`;
    this.scrub.style.width = `${this.axis.width - 2 * half + kThumb}px`;
    this.heat?.resize(this.axis, theme());
    for (const plot of this.plots.values()) plot.resize(this.axis, theme());
    this.placeHead();
  }

  setFrame(frame) {
    this.frame = frame;
    this.scrub.value = String(frame);
    const told = `frame ${frame}, ${seconds(frame, this.motion.rate)}`;
    this.scrub.setAttribute('aria-valuetext', told);
    this.told.textContent = `${frame} / ${this.motion.frameCount - 1}`;
    this.heat?.setFrame(frame);
    for (const plot of this.plots.values()) plot.setFrame(frame);
    this.placeHead();
  }

  placeHead() {
    this.head.style.transform = `translateX(${this.axis.gutter + this.axis.x(this.frame ?? 0)}px)`;
  }

  dispose() {
    this.sizes.disconnect();
    this.stopTheme();
    for (const plot of this.plots.values()) plot.destroy();
    this.others?.remove();
    this.element.remove();
  }
}
