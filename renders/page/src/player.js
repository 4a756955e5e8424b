// Chooses the frame that is shown. Frames are whole numbers; while playing, time runs and the frame is its nearest one,
// so that every picture is a frame that was judged, never something in between.

export class Player {
  // calls: frame(n) after every change, playing(flag)
  constructor(calls) {
    this.calls = calls;
    this.speed = 1;
    this.loop = false;
    this.playing = false;
    this.lag = 0;
    this.frame = 0;
    this.setMotion(1, 60, 0);
  }

  setMotion(frameCount, rate, frame) {
    this.frameCount = frameCount;
    this.rate = rate;
    this.frame = -1;
    this.seek(frame);
  }

  seek(frame) {
    const next = Math.max(0, Math.min(this.frameCount - 1, Math.round(frame)));
    this.time = next / this.rate;
    this.show(next);
  }

  step(count) {
    this.pause();
    this.seek(this.frame + count);
  }

  show(frame) {
    if (frame === this.frame) return;
    this.frame = frame;
    this.calls.frame(frame);
  }

  play() {
    if (this.playing) return;
    if (this.frame === this.frameCount - 1) this.seek(0);
    this.playing = true;
    this.calls.playing(true);
    this.lag = 0;  // Milliseconds from one picture to the next, smoothed.
    let before = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      // A tab that slept must not jump to the end.
      this.advance(Math.min(0.25, Math.max(0, now - before) / 1000) * this.speed);
      this.lag += 0.3 * (now - before - this.lag);
      before = now;
      if (this.playing) requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  advance(seconds) {
    const end = (this.frameCount - 1) / this.rate;
    this.time += seconds;
    if (this.time > end && this.loop && end > 0) this.time %= end;
    this.show(Math.round(Math.min(this.time, end) * this.rate));
    if (this.time >= end && !this.loop) this.pause();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.time = this.frame / this.rate;
    this.calls.playing(false);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }
}
