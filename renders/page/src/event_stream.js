// Server-sent events that come back: a browser reconnects by itself after a lost connection, but gives up after an
// answer that is an error, and holds one of its six connections per server as long as a page is open, seen or not.

const kFirstRetry_s = 1;
const kLongestRetry_s = 15;
const kHiddenFor_s = 30;

export class EventStream {
  // calls: event(kind, data), state('open' | 'lost'), and refused(): awaited before a new try after an error answer;
  // it may change `path` or throw to end the stream.
  constructor(path, kinds, calls) {
    Object.assign(this, { path, kinds, calls });
    this.retry_s = kFirstRetry_s;
    this.seen = () => this.changeSeen();
    document.addEventListener('visibilitychange', this.seen);
    this.open();
  }

  open() {
    this.source?.close();
    clearTimeout(this.timer);
    const source = this.source = new EventSource(this.path);
    source.onopen = () => { this.retry_s = kFirstRetry_s; this.calls.state('open'); };
    source.onerror = () => this.lost(source);
    for (const kind of this.kinds) source.addEventListener(kind, (event) => this.take(source, kind, event));
  }

  take(source, kind, event) {
    if (source !== this.source) return;
    let data;
    try {
      data = JSON.parse(event.data);
    } catch {
      return;  // A broken event is none.
    }
    this.calls.event(kind, data);
  }

  lost(source) {
    if (source !== this.source || this.closed) return;
    this.calls.state('lost');
    if (source.readyState !== EventSource.CLOSED) return;  // The browser tries again by itself.
    this.timer = setTimeout(() => this.again(), 1000 * this.retry_s);
    this.retry_s = Math.min(kLongestRetry_s, 2 * this.retry_s);
  }

  async again() {
    try {
      await this.calls.refused?.();
    } catch {
      if (!this.closed) this.lost(this.source);
      return;
    }
    if (!this.closed) this.open();
  }

  changeSeen() {
    clearTimeout(this.hiding);
    const sleep = () => { this.asleep = true; this.source.close(); };
    if (document.hidden) this.hiding = setTimeout(sleep, 1000 * kHiddenFor_s);
    else if (this.asleep) { this.asleep = false; this.open(); }
  }

  close() {
    this.closed = true;
    clearTimeout(this.timer);
    clearTimeout(this.hiding);
    document.removeEventListener('visibilitychange', this.seen);
    this.source.close();
  }
}
