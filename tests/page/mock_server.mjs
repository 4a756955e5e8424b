// A server that answers as docs/reference/server.md says, with made-up motion: for what the real one does only on bad
// days (busy, gone, hostile names), and for work on the pages without it.
//
//   node mock_server.mjs --contort BINARY --pages DIR [--report DIR] [--port N]
import { execFileSync } from 'node:child_process';
import { createServer } from 'node:http';
import { existsSync, readFileSync } from 'node:fs';
import { extname, join, normalize, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { MockSession, Refusal } from './mock_session.mjs';

const kTypes = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css', '.png': 'image/png',
  '.webp': 'image/webp', '.json': 'application/json' };
const kPolicy = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; " +
  "base-uri 'none'; form-action 'none'";

function catalogueOf(contort, more) {
  const listed = (what) => JSON.parse(execFileSync(contort, ['list', what, '--json'], { maxBuffer: 1e8 }));
  const parts = listed('parts');
  const sockets = Object.fromEntries(parts.map(({ name, kind }) =>
    [name, { arm: ['wrist', 'grip'], hand: ['grip'], head: ['face'], torso: ['back', 'chest'] }[kind] ?? []]));
  return {
    version: 'mock', read_only: false, corpus: true, characters: listed('characters'), parts, actions: listed('actions'),
    sockets, checks: listed('checks'), modes: ['kinematic', 'tracking', 'dynamic'], limits: { sessions: 16 }, ...more,
  };
}

export class MockServer {
  // options: contort, pages, report?, frameCount?, catalogue? (what differs), subject? (name of what fails)
  constructor(options) {
    Object.assign(this, { frameCount: 600, ...options });
    this.catalogue = catalogueOf(this.contort, options.catalogue);
    this.sessions = new Map();
    this.commands = [];
    this.faults = [];  // {path, status, code, text, times, retry_after}
    this.corpus = new Map();
    this.jobs = new Map();
    this.held = null;  // true: the next job runs until what is put here then is called
    this.listeners = new Set();
    this.next = 1;
    this.reports = 0;
  }

  async start(port = 0) {
    this.server = createServer((request, answer) => this.handle(request, answer));
    await new Promise((done) => this.server.listen(port, '127.0.0.1', done));
    this.url = `http://127.0.0.1:${this.server.address().port}/`;
    return this;
  }

  stop() {
    for (const session of this.sessions.values()) session.end();
    for (const listener of this.listeners) listener.end();
    this.server.closeAllConnections();
    return new Promise((done) => this.server.close(done));
  }

  // Ends all sessions, as a restart does.
  forget() {
    for (const session of this.sessions.values()) session.end();
    this.sessions.clear();
  }

  async handle(request, answer) {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    try {
      const fault = this.faults.find((one) => path.includes(one.path) && one.times-- > 0);
      if (fault) {
        if (fault.retry_after) answer.setHeader('Retry-After', fault.retry_after);
        throw new Refusal(fault.status, fault.code ?? 'mock', fault.text ?? 'The server is busy.');
      }
      if (!path.startsWith('/api/')) { this.file(path, answer); return; }
      const body = await this.bodyOf(request);
      const found = await this.api(request.method, path.split('/').slice(2), body, request, answer);
      if (found !== undefined) answer.writeHead(200, { 'content-type': 'application/json' }).end(JSON.stringify(found));
    } catch (error) {
      if (!(error instanceof Refusal)) console.error(error);
      const { status = 500, code = 'internal', pointer = '' } = error;
      answer.writeHead(status, { 'content-type': 'application/json' }).end(JSON.stringify({ code, pointer, text: error.message }));
    }
  }

  async bodyOf(request) {
    if (request.method === 'GET' || request.method === 'DELETE') return null;
    if (request.headers['content-type'] !== 'application/json') throw new Refusal(400, 'request.type', 'Only JSON is understood.');
    const chunks = [];
    for await (const chunk of request) chunks.push(chunk);
    return JSON.parse(Buffer.concat(chunks));
  }

  file(path, answer) {
    const name = normalize(path).replace(/^[/\\]+/, '');
    if (!name) { answer.writeHead(302, { location: '/report/index.html' }).end(); return; }
    const [folder, rest] = name === 'play' ? [this.pages, 'play.html'] : name.startsWith('page/') ? [this.pages, name.slice(5)] :
      [this.report ?? this.pages, name.replace(/^report\//, '')];
    const file = join(folder, rest);
    if (!file.startsWith(resolve(folder)) || !existsSync(file)) throw new Refusal(404, 'path.unknown', `There is no ${path}.`);
    let text = readFileSync(file);
    const served = rest.endsWith('.html') && name !== 'play';
    const headers = { 'content-type': kTypes[extname(file)] ?? 'application/octet-stream' };
    if (served) text = this.withLive(text.toString());
    else headers['content-security-policy'] = kPolicy;
    answer.writeHead(200, headers).end(text);
  }

  // A report as the server hands it out: with live.js, and allowed to load it.
  withLive(text) {
    return text.replace("default-src 'none';", "default-src 'none'; connect-src 'self';")
      .replace('style-src ', "style-src 'self' ").replace('script-src ', "script-src 'self' ")
      .replace('</head>', '<script src="/page/live.js" defer></script></head>');
  }

  stream(answer, listeners) {
    answer.writeHead(200, { 'content-type': 'text/event-stream', 'cache-control': 'no-store' });
    answer.write('retry: 300\n\n');
    listeners.add(answer);
    answer.on('close', () => listeners.delete(answer));
  }

  session(id) {
    const session = this.sessions.get(id);
    if (!session) throw new Refusal(404, 'session.unknown', `There is no session ${id}.`);
    return session;
  }

  async api(method, [what, id, rest], body, request, answer) {
    if (what === 'catalogue') return this.catalogue;
    if (what === 'events') {
      this.stream(answer, this.listeners);
      answer.write(`event: corpus\ndata: {"revision":"${this.next}"}\n\nevent: report\ndata: {"revision":${this.reports}}\n\n`);
      return undefined;
    }
    if (what === 'report') return this.job('report', () => { this.tell('report', { revision: ++this.reports }); return {}; });
    if (what === 'jobs') return this.jobs.get(id) ?? Promise.reject(new Refusal(404, 'job.unknown', `There is no job ${id}.`));
    if (what === 'corpus') return this.corpusCall(method, id, rest, body);
    if (what !== 'sessions') throw new Refusal(404, 'call.unknown', 'There is no such call.');
    if (method === 'POST' && !id) {
      const session = new MockSession(this, `s${this.next++}`, body);
      this.sessions.set(session.id, session);
      return session.state();
    }
    const session = this.session(id);
    if (method === 'DELETE') { session.end(); this.sessions.delete(id); return {}; }
    if (!rest) return session.state();
    if (rest === 'model') return session.model.answer;
    if (rest === 'motion.glb') { answer.writeHead(200).end(Buffer.from(session.model.answer.glb, 'base64')); return undefined; }
    if (rest === 'stream') { this.stream(answer, session.streams); session.send(answer); return undefined; }
    if (rest === 'frames') { answer.writeHead(200).end(session.bytes(new URL(request.url, 'http://x').searchParams)); return undefined; }
    if (rest === 'case') return this.save(session, body);
    return session.command(rest, body);
  }

  save(session, { check, subject }) {
    const bucket = `${check}-0123abcd`;
    const isNew = !this.corpus.has(bucket);
    this.corpus.set(bucket, { bucket, check, subject, state: 'new', cases: { min: { spec: session.spec } } });
    return { bucket, is_new: isNew };
  }

  corpusCall(method, id, rest, body) {
    if (!id) return { buckets: [...this.corpus.values()] };
    if (this.catalogue.read_only && method === 'POST') throw new Refusal(403, 'server.read_only', 'This server only shows.');
    if (rest) this.commands.push({ name: rest, bucket: id, body });
    if (rest === 'shrink' || rest === 'replay') return this.job(rest, () => ({ bucket: id }));
    if (rest) { this.tell('corpus', { revision: this.next++ }); return { bucket: id }; }
    if (!this.corpus.has(id)) throw new Refusal(404, 'bucket.unknown', `There is no bucket ${id}.`);
    return this.corpus.get(id);
  }

  // Runs for a while, or until `held` is called where there is one.
  job(kind, work) {
    const id = `j${this.next++}`;
    const job = { job: id, kind, state: 'queued', seconds: 0, text: '', result: null };
    this.jobs.set(id, job);
    setTimeout(() => Object.assign(job, { state: 'running', text: 'half done', seconds: 0.3 }), 300);
    const finish = () => { Object.assign(job, { state: 'done', text: `${kind} is done`, seconds: 0.9, result: work() }); this.tell('job', job); };
    if (this.held) this.held = finish;
    else setTimeout(finish, 900);
    return { job: id };
  }

  tell(kind, data) {
    for (const listener of this.listeners) listener.write(`event: ${kind}\ndata: ${JSON.stringify(data)}\n\n`);
  }
}

// The server can also be started by itself.
if (import.meta.url === pathToFileURL(process.argv[1]).href) {
  const words = Object.fromEntries(process.argv.slice(2).join(' ').split('--').slice(1).map((word) => word.trim().split(' ')));
  const mock = new MockServer({ contort: words.contort, pages: resolve(words.pages), report: words.report && resolve(words.report) });
  console.log((await mock.start(Number(words.port ?? 0))).url);
}
