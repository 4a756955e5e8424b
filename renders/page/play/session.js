// One session of the server: its commands, one after another, and its stream.
import { ApiError, call, get, post } from '../src/api.js';
import { EventStream } from '../src/event_stream.js';

const kAgain = 'The session had ended, because nobody used it or the server was started anew. It begins again.';
const kKinds = ['take', 'clock', 'frames', 'margins', 'spans', 'problem'];

export class Session {
  // calls: state(state), event(kind, data), connection('open' | 'lost'), waiting(text), again(text)
  constructor(calls) {
    this.calls = calls;
    this.id = '';
    this.state = null;
    this.order = Promise.resolve();
  }

  path(rest = '') {
    return `/api/sessions/${encodeURIComponent(this.id)}${rest}`;
  }

  // body: {spec, modes, library?}. What was open before is given back.
  async begin(body) {
    const before = this.id;
    const state = await post('/api/sessions', body, this.options());
    if (before) call('DELETE', `/api/sessions/${encodeURIComponent(before)}`).catch(() => {});
    this.begun = body;
    this.enter(state);
  }

  // Continues an existing session after the page was loaded again. Returns false if it has ended.
  async resume(id) {
    this.id = id;
    try {
      this.enter(await get(this.path(), this.options()));
      return true;
    } catch (error) {
      this.id = '';
      if (error.status === 404) return false;
      throw error;
    }
  }

  enter(state) {
    this.id = state.session;
    this.state = null;
    this.adopt(state);
    this.stream?.close();
    this.stream = new EventStream(this.path('/stream'), kKinds, {
      event: (kind, data) => this.calls.event(kind, data),
      state: (which) => this.calls.connection(which),
      refused: () => this.restore(),
    });
  }

  options() {
    return { waiting: (text) => this.calls.waiting(text) };
  }

  adopt(state) {
    if (!state || typeof state !== 'object') return;
    const old = this.state;
    if (old && (state.take < old.take || (state.take === old.take && state.revision < old.revision))) return;
    this.state = state;
    this.calls.state(state);
  }

  // The stream was refused: the session may have ended. Then its spec begins anew; nothing but its clock is lost.
  async restore() {
    try {
      this.adopt(await get(this.path()));
    } catch (error) {
      if (error.status !== 404) throw error;
      const { spec, modes } = this.state ?? this.begun;
      const state = await post('/api/sessions', { ...this.begun, spec, modes });
      this.id = state.session;
      this.state = null;
      this.adopt(state);
      this.stream.path = this.path('/stream');
      this.calls.again(kAgain);
    }
  }

  async refresh() {
    this.adopt(await get(this.path()));
  }

  // Commands are sent one after another: each is made for the state that the one before left.
  command(name, body) {
    const made = this.order.then(() => post(this.path(`/${name}`), body, this.options()));
    this.order = made.then((state) => this.adopt(state), () => {});
    return made;
  }

  model() {
    return get(this.path('/model'), this.options());
  }

  async frames(mode, from, count) {
    const path = this.path(`/frames?mode=${encodeURIComponent(mode)}&from=${from}&count=${count}`);
    return (await call('GET', path, undefined, { ...this.options(), as: 'blob' })).arrayBuffer();
  }

  // Returns the motion as a file to be saved.
  motion(mode) {
    return call('GET', this.path(`/motion.glb?mode=${encodeURIComponent(mode)}`), undefined,
      { ...this.options(), as: 'blob' });
  }

  // {check, subject, mode, take?}; `take` where the finding is not one of the present take.
  save(finding) {
    return post(this.path('/case'), finding, this.options());
  }
}

// Makes an error from one that came through the stream.
export function problemOf(data) {
  return new ApiError({
    status: 200, code: String(data?.code ?? ''), pointer: String(data?.pointer ?? ''), text: String(data?.text ?? ''),
  });
}
