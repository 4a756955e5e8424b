// The time axis that scrub bar, heat map, curves and spans share: one column per frame, right of the names.

export class Axis {
  constructor(frameCount) {
    this.frameCount = frameCount;
    this.resize(0, 0);
  }

  resize(gutter, width) {
    this.gutter = gutter;
    this.width = Math.max(1, width - gutter);
  }

  column() {
    return this.width / this.frameCount;
  }

  // Middle of the frame's column, from the left end of the axis.
  x(frame) {
    return (frame + 0.5) * this.column();
  }

  frameAt(x) {
    return Math.max(0, Math.min(this.frameCount - 1, Math.floor(x / this.column())));
  }
}

// Press or drag on the element shows the frame under the pointer.
export function seekByPointer(element, frameAt, seek) {
  let pressed = false;
  const go = (event) => seek(frameAt(event.clientX));
  element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    pressed = true;
    element.setPointerCapture(event.pointerId);
    go(event);
  });
  element.addEventListener('pointermove', (event) => { if (pressed) go(event); });
  for (const kind of ['pointerup', 'pointercancel', 'lostpointercapture'])
    element.addEventListener(kind, () => { pressed = false; });
}
