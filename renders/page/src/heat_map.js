// All curves at once: a row for each, a column for each frame, coloured by how far from the limit.
import { el } from './dom.js';
import { margin, number } from './format.js';
import { heatColour } from './theme.js';
import { seekByPointer } from './axis.js';

const kRow = 16;
const kGap = 2;

export class HeatMap {
  constructor(curves, calls) {
    this.calls = calls;  // seek(frame), frameAt(clientX)
    this.row = 0;
    this.end = Infinity;  // Later columns are not painted.
    this.names = el('div', { class: 'names', 'aria-hidden': 'true' });
    this.setCurves(curves);
    this.canvas = el('canvas', {
      class: 'heat-canvas', tabindex: '0', role: 'application', 'aria-describedby': 'heat-readout',
      'aria-label': 'Heat map of all curves. Up and down choose a curve, left and right a frame.',
    });
    this.readout = el('p', { class: 'readout', id: 'heat-readout' });
    this.element = el('div', { class: 'heat' },
      el('div', { class: 'row' }, this.names, el('div', { class: 'track' }, this.canvas)),
      el('div', { class: 'row' }, el('span'), el('div', { class: 'heat-foot' }, this.readout, legend())));
    this.listen();
  }

  setCurves(curves) {
    this.curves = curves;
    this.row = Math.min(this.row, Math.max(0, curves.length - 1));
    this.names.replaceChildren(...curves.map((curve) =>
      el('span', { text: curveName(curve), title: curveName(curve) })));
    if (this.axis) this.resize(this.axis, this.colours);
  }

  // Frames from `end` on are still to come. Only new columns are painted, if there are no others.
  setEnd(end) {
    const before = this.end;
    this.end = end;
    if (this.axis && end < before) this.paint();
    else if (this.axis) this.paintColumns(before, end);
  }

  listen() {
    const { canvas } = this;
    seekByPointer(canvas, this.calls.frameAt, this.calls.seek);
    canvas.addEventListener('pointermove', (event) => {
      const y = event.clientY - canvas.getBoundingClientRect().top;
      this.row = Math.max(0, Math.min(this.curves.length - 1, Math.floor(y / kRow)));
      this.tell(this.calls.frameAt(event.clientX), false);
    });
    canvas.addEventListener('pointerleave', () => this.tell(this.frame, false));
    canvas.addEventListener('focus', () => this.tell(this.frame, true));
    canvas.addEventListener('keydown', (event) => {
      const way = { ArrowUp: -1, ArrowDown: 1 }[event.key];
      if (!way) return;
      event.preventDefault();
      this.row = Math.max(0, Math.min(this.curves.length - 1, this.row + way));
      this.tell(this.frame, true);
      this.paint();
    });
    canvas.addEventListener('blur', () => this.paint());
  }

  setFrame(frame) {
    this.frame = frame;
    this.tell(frame, document.activeElement === this.canvas);
  }

  // Spoken only to someone who is on the map with the keyboard.
  tell(frame, aloud) {
    const curve = this.curves[this.row];
    if (!curve || frame === undefined) return;
    if (aloud) this.readout.setAttribute('aria-live', 'polite');
    else this.readout.removeAttribute('aria-live');
    const value = curve.margins[frame] ?? null;
    const share = value === null ? '' : `, ${number(value / curve.scale)} of its scale`;
    const told = value === null ? 'not judged' : margin(value, curve.unit);
    this.readout.textContent = `${curveName(curve)}: frame ${frame}, ${told}${share}`;
  }

  resize(axis, colours) {
    this.axis = axis;
    this.colours = colours;
    const ratio = window.devicePixelRatio || 1;
    const height = this.curves.length * kRow;
    this.canvas.width = Math.round(axis.width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.height = `${height}px`;
    this.ratio = ratio;
    this.paint();
  }

  paint() {
    if (!this.axis) return;
    const c = this.canvas.getContext('2d');
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, this.axis.width, this.curves.length * kRow);
    this.curves.forEach((curve, row) => {
      c.fillStyle = this.colours.grid;
      c.fillRect(0, row * kRow + kRow / 2 - 1, this.axis.width, 1);  // This line stays where nothing was judged.
    });
    this.paintColumns(0, this.end);
    if (document.activeElement !== this.canvas) return;
    c.strokeStyle = this.colours.curve;
    c.lineWidth = 2;
    c.strokeRect(1, this.row * kRow, this.axis.width - 2, kRow - 1);
  }

  paintColumns(from, end) {
    const c = this.canvas.getContext('2d');
    const last = Math.min(end, this.axis.frameCount);
    this.curves.forEach((curve, row) => this.paintRow(c, curve, row * kRow, from, last));
  }

  paintRow(c, curve, y, from, end) {
    const { axis, colours } = this;
    const column = axis.column();
    for (let frame = from; frame < end; ++frame) {
      const value = curve.margins[frame];
      if (value === null || value === undefined) continue;
      c.fillStyle = heatColour(colours, value / curve.scale);
      // Up to the next pixel, so that no light lines are between columns.
      const left = Math.floor(frame * column);
      c.fillRect(left, y, Math.max(1, Math.ceil((frame + 1) * column) - left), kRow - kGap);
    }
  }
}

export function curveName(curve) {
  return [curve.check, curve.subject].filter(Boolean).join(' ');
}

function legend() {
  return el('p', { class: 'legend' },
    ...['worst', 'bad', 'near', 'safe'].map((look, i) => el('span', {}, el('span', { class: `swatch ${look}` }),
      ['far beyond', 'violated', 'near the limit', 'safe'][i])));
}
