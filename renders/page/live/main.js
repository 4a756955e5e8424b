// The functions of a report while `contort serve` shows it: triage, jobs, and a list that changes when the report does.
// The report is complete without this.
import './live.css';
import { finished, get, jobText, post, sentence } from '../src/api.js';
import { el } from '../src/dom.js';
import { EventStream } from '../src/event_stream.js';
import { Refresh } from './refresh.js';
import { TriageBar } from './triage.js';

const kSettle_ms = 300;  // Several events in a row are one change.

class Live {
  constructor(catalogue) {
    this.writes = !catalogue.read_only && catalogue.corpus !== false;
    this.bars = new Map();
    this.revisions = {};
    this.refresh = new Refresh();
    this.status = el('p', { class: 'live-status', role: 'status', 'aria-live': 'polite' });
    this.anew = el('button', { type: 'button', text: 'Make the report anew', on: { click: () => this.remake() } });
    this.anew.hidden = !this.writes;
    this.top = el('nav', { class: 'live-top', 'aria-label': 'Server' },
      el('a', { href: '/play', text: 'Playground' }), this.anew);
    document.body.prepend(this.top);
    document.body.append(this.status);
    this.addBars();
    document.addEventListener('contort:case', ({ detail }) => this.addToCase(detail));
    this.addToOpen();
    this.stream = new EventStream('/api/events', ['corpus', 'report', 'job'], {
      event: (kind, data) => this.take(kind, data), state: (state) => this.connection(state),
    });
  }

  say(text) {
    this.status.textContent = text;
    clearTimeout(this.fading);
    if (text) this.fading = setTimeout(() => { this.status.textContent = ''; }, 15_000);
  }

  connection(state) {
    if (state === 'lost' && !this.lost) this.say('The connection to the server is lost; trying again.');
    if (state === 'open' && this.lost) { this.say('Connected again.'); this.later(); }
    this.lost = state === 'lost';
  }

  take(kind, data) {
    if (kind === 'job') return;  // Whoever began a job asks for it.
    // The first one only says where things stand.
    const known = this.revisions[kind];
    this.revisions[kind] = data.revision;
    if (known === undefined || known === data.revision) return;
    if (kind === 'report') this.later();
    else this.anew.classList.add('due');
  }

  later() {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.update(), kSettle_ms);
  }

  async update() {
    try {
      const told = await this.refresh.run((bucket) => this.barOf(bucket));
      this.addBars();
      this.anew.classList.remove('due');
      if (told) this.say(told);
    } catch (error) {
      this.say(`The new report cannot be read: ${sentence(error)}`);
    }
  }

  async remake() {
    this.anew.disabled = true;
    try {
      const { job } = await post('/api/report', {});
      await finished(job, (state) => this.say(jobText('Report', state)));
      this.later();
    } catch (error) {
      this.say(sentence(error));
    }
    this.anew.disabled = false;
  }

  barOf(key) {
    if (!this.bars.has(key)) this.bars.set(key, new TriageBar(key, this.writes));
    return this.bars.get(key).element;
  }

  addBars() {
    for (const bucket of document.querySelectorAll('.bucket[data-case]')) {
      const bar = this.barOf(bucket.dataset.case);
      if (bar.parentElement !== bucket) bucket.append(bar);
    }
  }

  // A case that was opened before this was ready.
  addToOpen() {
    const element = document.getElementById('case');
    const key = new URLSearchParams(location.hash.slice(1)).get('case');
    if (key && element && !element.hidden) this.addToCase({ key, element });
  }

  // An open case has its own, so that nobody has to go back to the list.
  addToCase({ key, element }) {
    const place = element.querySelector('.facts-row') ?? element.querySelector('.case-head');
    place?.after(new TriageBar(key, this.writes).element);
  }
}

async function start() {
  document.head.append(el('link', { rel: 'stylesheet', href: '/page/live.css' }));
  try {
    new Live(await get('/api/catalogue'));
  } catch (error) {
    document.body.prepend(el('p', { class: 'live-top problem', role: 'alert', text: sentence(error) }));
  }
}

start();
