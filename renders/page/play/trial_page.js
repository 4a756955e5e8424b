// A finding with other values: the open case of a report, whose motions this page makes itself, without the server
// (docs/internals/wasm.md).
import { CaseView } from '../src/case_view.js';
import { el } from '../src/dom.js';
import { startEngine } from '../src/engine.js';

export const hasEngine = () => 'engine' in document.documentElement.dataset;

// The server has the scripts of a report in another folder.
function load(file) {
  return new Promise((done, failed) => {
    const src = file.replace('viewer/', '/page/');
    document.head.append(el('script', { src, on: { load: done, error: failed } }));
  });
}

// Shows it in place of the playground, whose clock stands still meanwhile.
export async function openTrial(app, mode, { check, subject }) {
  await app.session.command('clock', { play: false });
  const engine = await startEngine(load);
  const { spec } = app.session.state;
  const text = JSON.stringify({ ...spec, dynamics: { ...spec.dynamics, mode } });
  const data = JSON.parse(engine.play(text, check, subject));
  const place = el('div', { class: 'case-view' });
  app.leave();
  app.element.before(place);
  try {
    const view = new CaseView(place, data, {
      loadEngine: load, back: '\u2190 Playground', onClose: () => { place.remove(); app.comeBack(); },
    });
    view.trial.element.open = true;
  } catch (error) {
    place.remove();
    app.comeBack();
    throw error;
  }
}
