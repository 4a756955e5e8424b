// The frame that the server's clock is in, between the server's words about it. Nothing is shown twice or backwards
// because a word came late.

const kSlack_s = 0.2;  // Differences up to here are delays on the way and are made up for little by little.

export class Clock {
  constructor() {
    this.begin(60, 1);
  }

  begin(rate, frameCount) {
    Object.assign(this, { rate, frameCount, playing: false, base: 0, since: 0 });
  }

  // Takes over what the server said at `now`, in milliseconds.
  set({ frame, playing }, now) {
    const own = this.time(now);
    const off = frame - own;
    const small = this.playing && playing && Math.abs(off) < kSlack_s * this.rate;
    this.base = small ? own + 0.2 * off : frame;
    this.since = now;
    this.playing = playing;
  }

  time(now) {
    return this.base + (this.playing ? (now - this.since) / 1000 * this.rate : 0);
  }

  frame(now) {
    return Math.max(0, Math.min(this.frameCount - 1, Math.floor(this.time(now) + 1e-6)));
  }
}
