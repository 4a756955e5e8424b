// The panel of the character that moves, its parts, and what it carries. Every change begins a new take where the
// figure stands.
import { el } from '../src/dom.js';
import { button, choice, form, numberField, panel } from './fields.js';
import { attachmentsOf, characterEntry, loadsOf, partsOf, socketChoices } from './spec_edit.js';

// A list of things, each with a button that takes it away.
function removable(items, name, remove) {
  return el('ul', { class: 'things' }, ...items.map((text, i) => el('li', {}, el('span', { text }),
    button('Remove', () => remove(i), { 'aria-label': `Remove ${name} ${text}`, class: 'small' }))));
}

export class CharacterPanel {
  constructor(app) {
    this.app = app;
    const names = app.catalogue.characters.map(({ name }) => [name, name]);
    this.name = choice('Character', names, names[0]?.[0], (name) => app.change({ character: { name } }));
    this.help = el('p', { class: 'dim' });
    this.parts = el('div', { class: 'fields two-columns' });
    this.object = choice('Object', [], '');
    this.socket = choice('Held at', [], '');
    this.objects = el('div');
    this.attach = form('Attach an object', () => this.addObject(), this.object.element, this.socket.element,
      el('button', { text: 'Attach' }));
    this.loads = el('div');
    this.loadAt = choice('Hung on', [], '');
    this.mass = numberField('Mass', { value: 10, low: 0.001, high: 10000, unit: 'kg' });
    this.hang = form('Hang a load', () => this.addLoad(), this.loadAt.element, this.mass.element,
      el('button', { text: 'Hang' }));
    this.element = panel('Character', true, this.name.element, this.help, this.parts,
      el('h3', { text: 'Objects' }), this.objects, this.attach,
      el('h3', { text: 'Loads' }), this.loads, this.hang);
  }

  update({ spec }) {
    const { catalogue } = this.app;
    const entry = characterEntry(catalogue, spec);
    this.name.set(catalogue.characters.map(({ name }) => [name, name]), spec.character?.name);
    this.help.textContent = entry?.help ?? '';
    this.showParts(entry, spec);
    const sockets = socketChoices(catalogue, spec);
    this.object.set((entry?.objects ?? []).map((name) => [name, name]), this.object.value());
    this.attach.hidden = !entry?.objects?.length;
    const grip = sockets.find(([, text]) => /right.*grip/.test(text))?.[0];
    this.socket.set(sockets, this.socket.value() || grip);
    this.loadAt.set(sockets, this.loadAt.value() || grip);
    const without = (list, i) => list.filter((_, at) => at !== i);
    this.objects.replaceChildren(removable(
      attachmentsOf(spec).map((one) => `${one.object} at ${one.slot} / ${one.socket}`), 'the object',
      (i) => this.changeCharacter({ attachments: without(attachmentsOf(this.spec), i) })));
    this.loads.replaceChildren(removable(
      loadsOf(spec).map((one) => `${one.mass_kg ?? 5} kg on ${one.slot} / ${one.socket}`), 'the load',
      (i) => this.app.change({ loads: without(loadsOf(this.spec), i) })));
    this.spec = spec;
  }

  // Rebuilt only for another character, so that the focus stays where it is.
  showParts(entry, spec) {
    const slots = Object.entries(entry?.slots ?? {}).filter(([, parts]) => parts.length > 1);
    const key = JSON.stringify(slots);
    if (key !== this.slotsKey) {
      this.slotsKey = key;
      this.choices = slots.map(([slot, parts]) => [slot, choice(slot, parts.map((part) => [part, part]), parts[0],
        (part) => this.swap(slot, part))]);
      this.parts.replaceChildren(...this.choices.map(([, one]) => one.element));
    }
    const now = partsOf(this.app.catalogue, spec);
    for (const [slot, one] of this.choices) one.select.value = now.get(slot);
  }

  changeCharacter(change) {
    this.app.change({ character: { ...this.spec.character, ...change } });
  }

  swap(slot, part) {
    this.changeCharacter({ parts: { ...this.spec.character.parts, [slot]: part } });
  }

  addObject() {
    const [slot, socket] = JSON.parse(this.socket.value());
    this.changeCharacter({ attachments: [...attachmentsOf(this.spec), { object: this.object.value(), slot, socket }] });
  }

  addLoad() {
    const [slot, socket] = JSON.parse(this.loadAt.value());
    this.app.change({ loads: [...loadsOf(this.spec), { slot, socket, mass_kg: this.mass.value() ?? 5 }] });
  }
}
