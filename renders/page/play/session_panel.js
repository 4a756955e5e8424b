// The panel of what a session gives back: its spec, its motion; and a fresh start.
import { copyText } from '../src/copy.js';
import { el } from '../src/dom.js';
import { button, choice, panel } from './fields.js';

export class SessionPanel {
  constructor(app) {
    this.app = app;
    this.mode = choice('Mode', [], '');
    this.spec = el('pre', { tabindex: '0', 'aria-label': 'Spec' });
    this.text = el('details', {}, el('summary', { text: 'Spec' }), this.spec);
    this.text.addEventListener('toggle', () => this.showSpec());
    this.element = panel('Session', true, el('div', { class: 'buttons' },
      button('Copy spec', () => this.copy()), button('Download .glb', () => this.download()),
      button('Start over', () => app.startOver())), this.mode.element, this.text);
  }

  update(state) {
    this.state = state;
    this.mode.set(state.modes.map((mode) => [mode, mode]), this.mode.value());
    this.mode.element.hidden = state.modes.length < 2;
    this.showSpec();
  }

  specText() {
    return `${JSON.stringify(this.state.spec, null, 2)}\n`;
  }

  showSpec() {
    if (this.text.open && this.state) this.spec.textContent = this.specText();
  }

  async copy() {
    const done = await copyText(this.specText());
    this.app.say(done ? 'The spec is copied: contort generate, check and shrink take it as a file.' :
      'The browser did not allow to copy: the spec is below.');
    if (!done) this.text.open = true;
  }

  async download() {
    await this.app.guard(async () => {
      const url = URL.createObjectURL(await this.app.session.motion(this.mode.value()));
      const name = `${this.state.spec.character?.name ?? 'motion'}_${this.mode.value()}.glb`;
      const link = el('a', { href: url, download: name });
      document.body.append(link);
      link.click();
      link.remove();
      setTimeout(() => URL.revokeObjectURL(url), 10_000);
    });
  }
}
