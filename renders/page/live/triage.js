// The buttons of one bucket: what people decide about a failure, and what the server can do with it.
import { finished, jobText, post, sentence } from '../src/api.js';
import { el } from '../src/dom.js';

const kOwner = 'contort.owner';
const kMostDays = 30;  // As `contort corpus quarantine` allows.

const day = (ahead) => new Date(Date.now() + 86_400_000 * ahead).toISOString().slice(0, 10);

function rememberedOwner() {
  try {
    return localStorage.getItem(kOwner) ?? '';
  } catch {
    return '';  // Some browsers forbid it.
  }
}

function rememberOwner(name) {
  try {
    localStorage.setItem(kOwner, name);
  } catch { /* See above. */ }
}

const owner = () => ({ name: 'owner', text: 'Owner', value: rememberedOwner(), autocomplete: 'username' });

// Name of the call: the button's text, the fields, and what is told afterwards.
const kForms = {
  acknowledge: {
    text: 'Acknowledge', fields: () => [owner(), { name: 'ticket', text: 'Ticket' }],
    told: ({ owner: who, ticket }) => `Acknowledged: ${who} looks after it, ticket ${ticket}.`,
  },
  quarantine: {
    text: 'Quarantine',
    fields: () => [owner(), { name: 'reason', text: 'Reason' },
      { name: 'expires', text: 'Last day', type: 'date', value: day(14), min: day(0), max: day(kMostDays) }],
    told: ({ owner: who, expires }) => `Quarantined by ${who} until ${expires}.`,
  },
  note: { text: 'Note', fields: () => [{ name: 'text', text: 'Note', wide: true }], told: () => 'The note is kept.' },
};

export class TriageBar {
  constructor(key, writes) {
    this.key = key;
    this.status = el('p', { class: 'live-job', role: 'status' });
    this.place = el('div');
    this.buttons = el('div', { class: 'live-buttons', role: 'group', 'aria-label': `Decide about ${key}` });
    if (writes) {
      for (const [call, { text }] of Object.entries(kForms))
        this.addButton(text, `live-${call}`, (button) => this.toggle(call, button), { 'aria-expanded': 'false' });
      this.addButton('Replay', 'live-replay', (button) => this.job('replay', 'Replay', button));
      this.addButton('Shrink', 'live-shrink', (button) => this.job('shrink', 'Shrink', button));
    }
    this.buttons.append(el('a',
      { class: 'live-play', href: `/play#case=${encodeURIComponent(key)}`, text: 'Open in playground' }));
    this.element = el('div', { class: 'live-bar' }, this.buttons, this.place, this.status);
  }

  addButton(text, look, click, more = {}) {
    const button = el('button', { type: 'button', class: look, text, on: { click: () => click(button) }, ...more });
    this.buttons.append(button);
  }

  path(call) {
    return `/api/corpus/${encodeURIComponent(this.key)}/${call}`;
  }

  // Opens the form of a call, or closes it. One at a time.
  toggle(call, button) {
    const same = this.opened === button;
    this.close();
    if (same) return;
    this.opened = button;
    button.setAttribute('aria-expanded', 'true');
    const form = this.form(call);
    this.place.replaceChildren(form);
    form.querySelector('input').focus();
  }

  close() {
    this.opened?.setAttribute('aria-expanded', 'false');
    this.opened = null;
    this.place.replaceChildren();
  }

  form(call) {
    const { text, fields } = kForms[call];
    const inputs = fields().map(({ name, text: label, wide, ...more }) => el('label', { class: wide ? 'wide' : null },
      el('span', { text: label }), el('input', { name, type: 'text', required: true, maxlength: '2000', ...more })));
    const form = el('form', { class: 'live-form', 'aria-label': `${text} ${this.key}`, on: {
      submit: (event) => { event.preventDefault(); this.send(call, form); },
      keydown: (event) => {
        if (event.key !== 'Escape') return;
        event.preventDefault();
        event.stopPropagation();
        const button = this.opened;
        this.close();
        button?.focus();
      },
    } }, ...inputs, el('button', { class: 'live-send', text }));
    return form;
  }

  async send(call, form) {
    const body = Object.fromEntries([...new FormData(form)].map(([name, value]) => [name, value.trim()]));
    if (body.owner) rememberOwner(body.owner);
    const send = form.querySelector('.live-send');
    send.disabled = true;
    try {
      await post(this.path(call), body, { waiting: (text) => this.say(text) });
      this.say(kForms[call].told(body));
      const button = this.opened;
      this.close();
      button?.focus();
    } catch (error) {
      this.say(sentence(error));
    }
    send.disabled = false;
  }

  async job(call, name, button) {
    button.disabled = true;
    try {
      const { job } = await post(this.path(call), {}, { waiting: (text) => this.say(text) });
      await finished(job, (state) => this.say(jobText(name, state)));
    } catch (error) {
      this.say(sentence(error));
    }
    button.disabled = false;
  }

  say(text) {
    if (this.status.textContent !== text) this.status.textContent = text;
  }
}
