// A margin over frames, with the limit, what is beyond it, and the frames of the violation.
import uPlot from 'uplot';
import { el } from './dom.js';
import { marginName, number } from './format.js';
import { intervalsOf } from './intervals.js';
import { curveName } from './heat_map.js';
import { seekByPointer } from './axis.js';

const kFrameSteps = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000, 100000];

// The limit is always in sight, with some space on both sides of it.
function limits(curve, end) {
  let low = 0;
  let high = 0;
  for (const value of curve.margins.slice(0, end)) {
    if (value === null || value === undefined) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const space = 0.12 * Math.max(high - low, 0.05 * curve.scale);
  return [low - space, high + space];
}

function shade(plot, curve, motion, colours) {
  const { ctx, bbox } = plot;
  const zero = plot.valToPos(0, 'y', true);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.fillStyle = colours.bad;
  ctx.fillRect(bbox.left, zero, bbox.width, bbox.top + bbox.height - zero);
  ctx.fillStyle = colours.during;
  for (const { first, last } of curve === motion.curves[0] ? intervalsOf(motion) : []) {
    const left = plot.valToPos(first - 0.5, 'x', true);
    ctx.fillRect(left, bbox.top, plot.valToPos(last + 0.5, 'x', true) - left, bbox.height);
  }
  ctx.fillStyle = colours.limit;
  ctx.fillRect(bbox.left, Math.round(zero), bbox.width, Math.max(1, Math.round(1.5 * uPlot.pxRatio)));
  ctx.restore();
}

const kLabel = 16;  // Pixels for the name of an axis.

function axes(small, axis, unit, colours) {
  const font = '12px system-ui, sans-serif';
  const common = {
    stroke: colours.dim, font, labelFont: font, labelSize: kLabel, labelGap: 0, ticks: { show: false },
    grid: { stroke: colours.grid, width: 1 },
  };
  return [
    // No text that the right end would cut off.
    { ...common, show: !small, label: 'frame', size: 24, gap: 2, space: 60, incrs: kFrameSteps,
      values: (_, ticks) => ticks.map((tick) => (axis.x(tick) + 5 * String(tick).length > axis.width ? '' : tick)) },
    { ...common, label: marginName(unit), size: axis.gutter - kLabel, space: small ? 20 : 26, gap: 8, values: (_, ticks) => ticks.map(number) },
  ];
}

export class CurvePlot {
  constructor(curve, motion, small, calls) {
    this.curve = curve;
    this.motion = motion;
    this.small = small;
    this.calls = calls;
    this.end = Infinity;  // Frames from here on are still to come.
    this.value = el('span', { class: 'curve-value' });
    this.title = el('p', { class: 'curve-title' }, el('span', { text: curveName(curve) }),
      el('span', { class: 'dim', text: `${marginName(curve.unit)}, below 0 is violated` }), this.value);
    this.holder = el('div', { class: 'curve-plot', role: 'img', 'aria-label': this.description() });
    this.element = el('figure', { class: small ? 'curve-figure small' : 'curve-figure' }, this.title, this.holder);
  }

  description() {
    const judged = this.curve.margins.filter((value) => value !== null);
    const lowest = judged.length ? number(Math.min(...judged)) : 'none';
    return `Margin of ${curveName(this.curve)} over frames, lowest ${lowest} ${this.curve.unit}`;
  }

  resize(axis, colours) {
    this.plot?.destroy();
    const { curve, motion, small } = this;
    const single = curve.margins.filter((value) => value !== null).length < 2;
    this.plot = new uPlot({
      width: axis.gutter + axis.width, height: small ? 84 : 168 + kLabel, padding: [6, 0, small ? 6 : 0, 0],
      legend: { show: false },
      cursor: { drag: { x: false, y: false, setScale: false }, points: { show: false }, y: false },
      select: { show: false },
      scales: {
        x: { time: false, range: [-0.5, motion.frameCount - 0.5] }, y: { range: () => limits(this.curve, this.end) },
      },
      axes: axes(small, axis, curve.unit, colours),
      series: [{}, { stroke: colours.curve, width: 2, points: { show: single, size: 6 }, spanGaps: false }],
      hooks: { drawClear: [(plot) => shade(plot, this.curve, motion, colours)] },
    }, this.values(), this.holder);
    seekByPointer(this.plot.over, this.calls.frameAt, this.calls.seek);
  }

  values() {
    const frames = Array.from({ length: this.motion.frameCount }, (_, frame) => frame);
    return [frames, frames.map((frame) => (frame < this.end ? this.curve.margins[frame] ?? null : null))];
  }

  // The same subject with other margins, or more of them.
  update(curve, end) {
    this.curve = curve;
    this.end = end;
    this.plot?.setData(this.values());
  }

  setFrame(frame) {
    const value = this.curve.margins[frame] ?? null;
    this.value.textContent = value === null ? `frame ${frame}: not judged` :
      `frame ${frame}: ${number(value)} ${this.curve.unit}`;
    this.value.classList.toggle('violated', value !== null && value < 0);
  }

  destroy() {
    this.plot?.destroy();
    this.element.remove();
  }
}
