// The findings so far, and what can be done about them: look, save as a case, shrink, see them in the report.
import { finished, jobText, post, sentence } from '../src/api.js';
import { el } from '../src/dom.js';
import { interval, margin } from '../src/format.js';
import { button } from './fields.js';
import { hasEngine, openTrial } from './trial_page.js';

const kShown = 60;

const reportLink = (bucket) => `/#case=${encodeURIComponent(bucket)}`;

// The lowest margin up to a frame, where the curve was sent; else what the finding says.
function worstUntil(finding, curves, now) {
  if (finding.worst <= now) return finding.worstMargin;
  const curve = curves.find(({ check, subject }) => check === finding.check && subject === finding.subject);
  let low = Infinity;
  for (let at = finding.first; at <= now; ++at) low = Math.min(low, curve?.margins[at] ?? Infinity);
  return low;
}

class Row {
  constructor(app, take, mode, finding) {
    Object.assign(this, { app, take, mode, finding });
    this.worst = el('span', { class: 'worst-margin' });
    this.when = el('span', { class: 'dim' });
    this.old = el('span', { class: 'chip', text: 'take before' });
    this.old.hidden = true;
    this.buttons = el('div', { class: 'buttons' });
    this.state = el('p', { class: 'job', role: 'status' });
    this.element = el('li', { class: 'finding' },
      el('p', { class: 'finding-name' }, el('span', { class: 'check', text: finding.check }), ' ',
        el('span', { text: finding.subject }), ' ', el('span', { class: 'chip', text: mode }), this.old),
      el('p', {}, this.worst, ' ', this.when), this.buttons, this.state);
    const name = `${finding.check} ${finding.subject}`;
    this.look = button('Look', () => app.look(this.finding.worst), { 'aria-label': `Look: ${name}` });
    this.save = button('Save as case', () => this.store(), { 'aria-label': `Save as case: ${name}` });
    this.buttons.append(this.look);
    if (hasEngine()) {
      this.trial = button('Try other values', () => this.guarded(() => openTrial(app, this.mode, this.finding)),
        { 'aria-label': `Try other values: ${name}` });
      this.buttons.append(this.trial);
    }
    if (app.writes) this.buttons.append(this.save);
  }

  update(finding, curves, now) {
    this.finding = finding;
    const worst = worstUntil(finding, curves, now);
    this.worst.textContent = worst === Infinity ? '' : `worst ${margin(worst, finding.unit)}`;
    const during = interval(finding.first, Math.min(now, finding.last));
    this.when.textContent = finding.worst <= now ? `at frame ${finding.worst}, ${during}` :
      `since frame ${finding.first}`;
  }

  // Its take is over: the frames are gone, the server still has it for a while.
  retire() {
    this.retired = true;
    this.old.hidden = false;
    this.look.remove();
    this.trial?.remove();
  }

  say(text) {
    if (this.state.textContent !== text) this.state.textContent = text;
  }

  async guarded(work) {
    const held = [...this.buttons.querySelectorAll('button')];
    for (const one of held) one.disabled = true;
    try {
      await work();
    } catch (error) {
      this.say(sentence(error));
    }
    for (const one of held) one.disabled = false;
  }

  store() {
    return this.guarded(async () => {
      const old = this.retired ? { take: this.take } : {};
      const { bucket, is_new: isNew } = await this.app.session.save({ ...this.finding.raw, mode: this.mode, ...old });
      this.bucket = bucket;
      this.save.remove();
      this.say(`${isNew ? 'Saved as a new bucket' : 'Saved; known already'}: ${bucket}`);
      this.shrinkButton = button('Shrink', () => this.shrink(),
        { 'aria-label': `Shrink: ${this.finding.check} ${this.finding.subject}` });
      this.buttons.append(this.shrinkButton, button('Add to the report', () => this.report(), { class: 'to-report' }));
      this.shrinkButton.focus();
    });
  }

  shrink() {
    return this.guarded(async () => {
      const { job } = await post(`/api/corpus/${encodeURIComponent(this.bucket)}/shrink`, {});
      const done = await finished(job, (state) => this.say(jobText('Shrink', state)));
      // The minimal case tells the bucket: shrinking may have moved the case to another.
      if (typeof done.result?.bucket === 'string') this.bucket = done.result.bucket;
    });
  }

  report() {
    return this.guarded(async () => {
      const { job } = await post('/api/report', {});
      await finished(job, (state) => this.say(jobText('Report', state)));
      this.say('The report was made anew.');
      this.buttons.querySelector('a')?.remove();
      this.buttons.append(el('a',
        { href: reportLink(this.bucket), target: '_blank', rel: 'noopener', text: 'Open in the report' }));
    });
  }
}

export class Findings {
  constructor(app) {
    this.app = app;
    this.rows = new Map();
    this.list = el('ul', { class: 'findings' });
    this.none = el('p', { class: 'dim', text: 'Nothing so far.' });
    this.live = el('p', { class: 'unseen', role: 'status', 'aria-live': 'polite' });
    this.count = el('span', { class: 'count' });
    this.element = el('section', { class: 'findings-place', 'aria-label': 'Findings' },
      el('h2', {}, 'Findings ', this.count), this.none, this.list, this.live);
  }

  // A new take: what the last one showed can be saved until the next one ends.
  begin(take) {
    for (const [key, row] of this.rows) {
      const keep = row.take === take || row.take === take - 1 || row.bucket;
      if (!keep) { row.element.remove(); this.rows.delete(key); }
      else if (row.take !== take && !row.retired) row.retire();
    }
    this.showCount();
  }

  // Those that have begun by now appear; those that a command undid go, unless they were saved.
  update(tracks, now) {
    const seen = new Set();
    let added = null;
    for (const [mode, { findings, curves }] of tracks.of) {
      const times = new Map();
      for (const finding of findings) {
        const name = `${finding.check} ${finding.subject}`;
        times.set(name, (times.get(name) ?? 0) + 1);
        if (finding.first > now || this.rows.size > kShown) continue;
        const key = `${tracks.take} ${mode} ${name} ${times.get(name)}`;
        seen.add(key);
        if (!this.rows.has(key)) added = this.add(key, tracks.take, mode, finding);
        this.rows.get(key).update(finding, curves, now);
      }
    }
    for (const [key, row] of this.rows)
      if (row.take === tracks.take && !seen.has(key) && !row.bucket) { row.element.remove(); this.rows.delete(key); }
    if (added) this.tell(added);
    this.showCount();
  }

  add(key, take, mode, finding) {
    const row = new Row(this.app, take, mode, finding);
    this.rows.set(key, row);
    this.list.prepend(row.element);
    return row;
  }

  // Once for several that come together.
  tell(row) {
    clearTimeout(this.telling);
    this.telling = setTimeout(() => {
      this.live.textContent = `Finding: ${row.finding.check} ${row.finding.subject}. ${this.rows.size} in all.`;
    }, 600);
  }

  showCount() {
    this.none.hidden = this.rows.size > 0;
    const text = this.rows.size ? String(this.rows.size) : '';
    if (this.count.textContent !== text) this.count.textContent = text;
  }
}
