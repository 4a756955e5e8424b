// Calls of the server (docs/reference/server.md). Everything that goes wrong becomes an ApiError with a sentence for
// the reader.

const kTries = 5;
const kLongestWait_s = 10;
const kUnreachable = 'The server cannot be reached. It may have stopped.';

export class ApiError extends Error {
  constructor({ status = 0, code = '', pointer = '', text = '' }) {
    super(text || `The server answered ${status} without saying why.`);
    Object.assign(this, { status, code, pointer });
  }
}

// The sentence, and where in what was sent.
export function sentence(error) {
  return error.pointer ? `${error.message} (at ${error.pointer})` : error.message;
}

const sleep = (seconds) => new Promise((done) => { setTimeout(done, 1000 * seconds); });

// Returns the time that the server asked for, or else one that grows with each attempt.
function waitOf(answer, attempt) {
  const asked = Number(answer.headers.get('Retry-After'));
  return Math.min(kLongestWait_s, asked > 0 ? asked : 2 ** attempt / 2);
}

async function errorOf(answer) {
  let told = {};
  try {
    told = await answer.json();
  } catch { /* Not from contort: a proxy in between, perhaps. */ }
  const word = (value) => (typeof value === 'string' ? value : '');
  return new ApiError({
    status: answer.status, code: word(told?.code), pointer: word(told?.pointer), text: word(told?.text),
  });
}

async function send(method, path, body) {
  const headers = method === 'GET' ? {} : { 'Content-Type': 'application/json' };
  const text = method === 'GET' || method === 'DELETE' ? undefined : JSON.stringify(body ?? {});
  try {
    return await fetch(path, { method, headers, body: text, cache: 'no-store' });
  } catch {
    throw new ApiError({ code: 'connection', text: kUnreachable });
  }
}

// options.waiting(text): told when the server is busy and the call is tried again; options.as: 'json' or 'blob'
export async function call(method, path, body, options = {}) {
  for (let attempt = 1; ; ++attempt) {
    const answer = await send(method, path, body);
    if (answer.status === 204) return null;
    if (answer.ok) return options.as === 'blob' ? answer.blob() : answer.json();
    const error = await errorOf(answer);
    const busy = answer.status === 429 || answer.status === 503;
    if (!busy || attempt === kTries) throw error;
    const seconds = waitOf(answer, attempt);
    options.waiting?.(`${error.message} Trying again in ${Math.ceil(seconds)} s.`);
    await sleep(seconds);
  }
}

export const get = (path, options) => call('GET', path, undefined, options);
export const post = (path, body, options) => call('POST', path, body, options);

// Asks for a job until it is over. `progress` gets each answer; a failed job throws its sentence.
export async function finished(job, progress, pause_s = 0.5) {
  for (;;) {
    const state = await get(`/api/jobs/${encodeURIComponent(job)}`);
    progress?.(state);
    if (state.state === 'done') return state;
    if (state.state === 'failed') throw new ApiError({ code: 'job.failed', text: state.text || 'The job failed.' });
    await sleep(pause_s);
  }
}

// "running for 3.2 s: 120 evaluations"
export function jobText(name, state) {
  const { seconds } = state;
  const word = state.state === 'running' ? 'for' : 'after';
  const time = Number.isFinite(seconds) && seconds > 0 ? ` ${word} ${seconds.toFixed(1)} s` : '';
  return `${name}: ${state.state}${time}${state.text ? `. ${state.text}` : ''}`;
}
