// The page /play. #case=BUCKET opens the minimal spec of that bucket.
import 'uplot/dist/uPlot.min.css';
import '../page.css';
import '../src/viewer.css';
import './play.css';
import { get, sentence } from '../src/api.js';
import { el } from '../src/dom.js';
import { emptySpec } from './spec_edit.js';
import { PlayView } from './view.js';

const kLiked = 'mech';  // The character with the most parts to swap.

const wantedCase = () => new URLSearchParams(location.hash.slice(1)).get('case');

async function openCase(view, bucket) {
  const found = await get(`/api/corpus/${encodeURIComponent(bucket)}`);
  const cases = found.cases ?? {};
  const { spec } = cases.min ?? Object.values(cases)[0] ?? {};
  if (!spec) throw new Error(`The bucket ${bucket} has no case.`);
  await view.session.begin({ spec, modes: [spec.dynamics?.mode ?? 'kinematic'] });
  view.title.replaceChildren('The minimal case of ',
    el('a', { href: `/#case=${encodeURIComponent(bucket)}`, text: bucket }));
}

async function openNew(view) {
  const names = view.catalogue.characters.map(({ name }) => name);
  const name = names.includes(kLiked) ? kLiked : names[0];
  const mode = view.catalogue.modes.includes('dynamic') ? 'dynamic' : view.catalogue.modes[0];
  if (!await view.begin(emptySpec(name), [mode])) return;
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) await view.command('clock', { play: true });
}

async function open(view) {
  const bucket = wantedCase();
  view.title.replaceChildren();
  await view.guard(async () => {
    if (bucket) { await openCase(view, bucket); return; }
    const before = sessionStorage.getItem('session');
    if (before && !view.session.id && await view.session.resume(before)) return;
    await openNew(view);
  });
}

async function start() {
  const place = document.getElementById('play');
  try {
    const view = new PlayView(place, await get('/api/catalogue'));
    window.contortPlay = view;
    window.addEventListener('hashchange', () => { if (wantedCase()) open(view); });
    await open(view);
  } catch (error) {
    place.append(el('p', { class: 'problem', role: 'alert', text: sentence(error) }));
  }
}

start();
