// The panel of the queue: what plays, what waits, and forms for what comes next.
import { el } from '../src/dom.js';
import { ActionForm } from './action_form.js';
import { button, checkField, form, labelled, panel } from './fields.js';
import { actionsText, lengthOf } from './spec_edit.js';

// Sequences of the queue are numbered as in the motion: those of the spec, then those of its interrupts.
function sequenceOf(spec, entry) {
  if (entry.sequence && typeof entry.sequence === 'object') return entry.sequence;
  if (!Number.isInteger(entry.sequence)) return { name: String(entry.sequence ?? '') };
  const queued = spec.sequences ?? [];
  return queued[entry.sequence] ?? spec.interrupts?.[entry.sequence - queued.length]?.sequence ?? null;
}

function titleOf(sequence) {
  if (!sequence) return 'a sequence';
  return [sequence.name, sequence.clips ? actionsText(sequence) : ''].filter(Boolean).join(': ') || 'a sequence';
}

export class QueuePanel {
  constructor(app) {
    this.app = app;
    this.actions = [];
    this.clips = [];
    this.list = el('ol', { class: 'queue' });
    this.none = el('p', { class: 'dim', text: 'Nothing is queued: the character stands.' });
    this.rows = el('div');
    this.pending = el('ol', { class: 'things' });
    this.name = el('input', { type: 'text', maxlength: '200', autocomplete: 'off' });
    this.resume = checkField('Go on afterwards with what was cut', true);
    this.form = form('Make a clip', (by) => this.send(by?.value ?? 'enqueue'), this.rows,
      el('div', { class: 'buttons' },
        button('Add an action at the same time', () => this.addAction(), { class: 'small' }),
        button('Then another clip', () => this.addClip(), { class: 'small' })),
      this.pending, labelled('Name, for reports', this.name), this.resume.element,
      el('div', { class: 'buttons' }, el('button', { value: 'enqueue', class: 'strong', text: 'Queue it' }),
        el('button', { value: 'interrupt', text: 'Interrupt with it' })));
    this.element = panel('Queue', true, this.none, this.list, el('h3', { text: 'New clip' }), this.form);
    this.addAction();
  }

  addAction() {
    const number = this.actions.length + 1;
    const one = new ActionForm(this.app, number, number > 1 ? () => {
      this.actions.splice(this.actions.indexOf(one), 1);
      one.element.remove();
    } : null);
    this.actions.push(one);
    this.rows.append(one.element);
    if (this.spec) one.update(this.spec);
    if (number > 1) one.slot.select.focus();
  }

  update(state) {
    const key = JSON.stringify([state.spec.character, this.app.model?.aims]);
    this.spec = state.spec;
    this.rate = state.rate_hz || state.spec.rate_hz || 60;
    if (key !== this.key) {
      this.key = key;
      for (const one of this.actions) one.update(this.spec);
    }
    const queue = state.queue ?? [];
    this.none.hidden = queue.length > 0;
    this.entries = queue.map((entry) => {
      const when = el('span', { class: 'dim' });
      const element = el('li', {}, el('span', { text: titleOf(sequenceOf(state.spec, entry)) }), ' ', when);
      return { entry, element, when };
    });
    this.list.replaceChildren(...this.entries.map(({ element }) => element));
    this.setFrame(this.frame ?? 0);
  }

  // Marks the entry that plays.
  setFrame(frame) {
    this.frame = frame;
    for (const { entry, element, when } of this.entries ?? []) {
      const state = frame > entry.last_frame ? 'over' : frame < entry.first_frame ? 'waits' : 'plays';
      if (element.dataset.state === state) continue;
      element.dataset.state = state;
      when.textContent = `\u2013 ${state}, frames ${entry.first_frame}\u2013${entry.last_frame}`;
    }
  }

  clip() {
    return { actions: this.actions.map((one) => one.read(this.rate)) };
  }

  addClip() {
    if (!this.form.reportValidity()) return;
    this.clips.push(this.clip());
    this.showPending();
  }

  showPending() {
    this.pending.replaceChildren(...this.clips.map((clip, i) => el('li', {},
      el('span', { text: `first ${actionsText({ clips: [clip] })}` }),
      button('Remove', () => { this.clips.splice(i, 1); this.showPending(); },
        { class: 'small', 'aria-label': `Remove clip ${i + 1}` }))));
  }

  // The clips that were put aside, one after another, and then the one of the form.
  sequence() {
    let at = 0;
    const clips = [...this.clips, this.clip()].map((clip) => {
      const placed = at ? { ...clip, start_frame: at } : clip;
      at += lengthOf(clip);
      return placed;
    });
    const name = this.name.value.trim();
    return name ? { name, clips } : { clips };
  }

  async send(way) {
    const sequence = this.sequence();
    const body = way === 'interrupt' ? { sequence, resume: this.resume.value() } : { sequence };
    if (!await this.app.command(way, body)) return;
    this.clips = [];
    this.showPending();
  }
}
