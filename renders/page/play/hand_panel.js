// Aiming and pushing with numbers, for those who do not use the picture, and the settings of both.
import { el } from '../src/dom.js';
import { choice, form, numberField, panel, pointField } from './fields.js';

export class HandPanel {
  constructor(app) {
    this.app = app;
    this.what = choice('What aims', [], '');
    this.target = pointField('Target', { unit: 'm', low: -1000, high: 1000 });
    this.aimFor = numberField('For', { unit: 's', low: 0.02, high: 60, placeholder: 'as the server presets it' });
    this.aimForm = form('Aim', () => this.aim(this.target.value()), this.what.element, this.target.element,
      this.aimFor.element, el('button', { text: 'Aim' }));
    this.means = choice('A click in the picture means', [['surface', 'the ground or obstacle there'],
      ['beside', 'a point as far away as the character']], 'surface');
    this.noAim = el('p', { class: 'dim', text: 'Nothing on this character can aim.' });
    this.joint = choice('Joint', [], '');
    this.point = pointField('Point', { unit: 'm, in the joint\u2019s frame', low: -10, high: 10, value: [0, 0, 0] });
    this.impulse = pointField('Impulse', { unit: 'N s, in the world', low: -10000, high: 10000, value: [0, 0, -20] });
    this.strength = numberField('A drag of 1 m is', { unit: 'N s', value: 150, low: 0.1, high: 10000 });
    this.pushForm = form('Push', () => this.pushByNumbers(), this.joint.element, this.point.element,
      this.impulse.element, el('button', { text: 'Push' }));
    this.noGive = el('p', { class: 'dim', text: 'Only in the mode dynamic does the character give way to a push.' });
    this.element = panel('Aim and push', true, this.noAim, this.aimForm, this.means.element,
      el('h3', { text: 'Push' }), this.noGive, this.strength.element, this.pushForm);
  }

  update({ modes }) {
    const { model } = this.app;
    this.noGive.hidden = modes.includes('dynamic');
    if (!model) return;
    const choiceOf = ({ slot, action }, point) => {
      const look = action === 'look_at';
      const value = { slot, ...(look ? { action } : {}), ...(point ? { point } : {}) };
      return [JSON.stringify(value), look ? `${slot} looks at it` : [slot, point].filter(Boolean).join(' / ')];
    };
    const aims = (model.aims ?? []).flatMap((one) =>
      (one.points?.length ? one.points : ['']).map((point) => choiceOf(one, point)));
    this.what.set(aims, this.what.value() || aims.find(([, text]) => /arm_right/.test(text))?.[0]);
    this.noAim.hidden = aims.length > 0;
    this.aimForm.hidden = !this.noAim.hidden;
    const joints = (model.joints ?? []).filter(({ slot }) => slot).map(({ name }) => [name, name]);
    this.joint.set(joints, this.joint.value() || joints.find(([name]) => /^torso/.test(name))?.[0]);
  }

  async aim(target) {
    if (!target || this.aimForm.hidden) return;
    const { what } = this;
    const chosen = JSON.parse(what.value());
    this.target.set(target);
    const duration = this.aimFor.value();
    const frames = duration ? { duration_frames: Math.max(1, Math.round(duration * this.app.tracks.rate)) } : {};
    const label = what.select.selectedOptions[0].textContent;
    const done = await this.app.command('aim', { ...chosen, target_m: target, ...frames });
    if (done) this.app.showTarget(chosen.slot, target, label);
  }

  pushByNumbers() {
    const joint = this.app.model.joints.find(({ name }) => name === this.joint.value());
    if (joint) this.push({ joint, point: this.point.value() ?? [0, 0, 0], impulse: this.impulse.value() ?? [0, 0, 0] });
  }

  // A joint that is the character's root belongs to a slot without a joint of its own.
  push({ joint, point, impulse }) {
    if (!joint.slot) {
      this.app.say(`Nothing can push ${joint.name}: it belongs to no slot.`);
      return;
    }
    const own = joint.name.startsWith(`${joint.slot}/`) ? { joint: joint.name.slice(joint.slot.length + 1) } : {};
    this.app.command('push', { slot: joint.slot, ...own, point_m: point, impulse_N_s: impulse });
  }

  // A click on the body: what the fields of the push are about.
  pick(joint, point) {
    this.joint.select.value = joint.name;
    this.point.set(point);
    this.app.say(`${joint.name} is chosen for a push with numbers. Drag to push it now.`);
  }
}
