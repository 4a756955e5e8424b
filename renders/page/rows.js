// The rows that the report's first page has no room for: loaded from files beside it once the page is there, and made
// into the same cards. Runs before page.js, which finds what it needs in window.contortPage. Texts are set with
// textContent only.
(() => {
  'use strict';
  const nonce = document.currentScript.nonce;

  // A script or style sheet from beside the page.
  const load = (tag, attributes) => new Promise((done, failed) => {
    const element = document.createElement(tag);
    element.nonce = nonce;
    Object.assign(element, attributes);
    element.onload = () => done(element);
    element.onerror = () => { element.remove(); failed(new Error('missing')); };
    document.head.append(element);
  });

  const make = (tag, attributes, ...children) => {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    return element;
  };

  const kStyled = new Set(['new', 'regressed', 'open', 'quarantined', 'fixed', 'flaky']);
  const chip = ([state, gating]) => {
    const element = make('span', { class: kStyled.has(state) ? `chip state-${state}` : 'chip' }, state || 'no state');
    if (gating) element.append(make('span', { class: 'unseen' }, ' (gating)'));
    return element;
  };

  const bucket = ({ key, text, open, command }) => {
    const element = make('section', { class: 'bucket', id: `case=${key}`, 'data-case': key }, make('p', { class: 'summary' }, text));
    if (open) element.append(make('button', { type: 'button', class: 'open' }, 'Look closer'));
    if (command)
      element.append(make('div', { class: 'command' }, make('code', {}, command),
        make('button', { type: 'button', class: 'copy', 'aria-label': 'Copy the replay command' }, 'Copy')));
    return element;
  };

  const card = (data) => make('article', {
    tabindex: '-1', class: data.gating ? 'card gating' : 'card', 'data-check': data.check,
    'data-character': data.character, 'data-parts': data.parts, 'data-phase': data.phase, 'data-state': data.state,
  }, make('div', { class: 'head' },
    make('h3', {}, make('span', { class: 'plain-name' }, data.title || ''), ' ',
      make('span', { class: 'check' }, data.check), ' ',
      make('span', { class: 'subject' }, data.subject)),
    make('p', { class: 'summary' }, ...data.chips.map(chip), ' ', make('span', {}, data.count))));

  // The places to which further buckets of a card go, by its number; those of the page itself say so in data-more.
  const places = new Map();
  const placeOf = (number) => {
    if (!places.has(number)) places.set(number, document.querySelector(`details[data-more="${Number(number)}"]`));
    return places.get(number);
  };

  const add = (data, into) => {
    const buckets = data.buckets.map(bucket);
    if (data.check === undefined) { placeOf(data.card).append(...buckets); return; }
    const element = card(data);
    element.append(...buckets.splice(0, 1));
    if (data.more) {
      const details = make('details', {}, make('summary', {}, data.more), ...buckets);
      places.set(data.card, details);
      element.append(details);
    }
    into.append(element);
  };

  let arrived = [];
  window.contortRows = (cards) => { arrived = cards; };

  const loadAll = async (failures, rest) => {
    const count = Number(failures.dataset.rowFiles) || 0;
    for (let i = 1; i <= count; ++i) {
      arrived = [];
      (await load('script', { src: `rows/part-${i}.js` })).remove();
      const cards = document.createDocumentFragment();
      for (const data of arrived) add(data, cards);
      rest.before(cards);
    }
    for (const note of document.querySelectorAll('.rest')) note.remove();
  };

  const tellMissing = (rest) => {
    rest.prepend('The files in the folder rows are missing or damaged, so some are not in this list: ');
    rest.classList.add('problem');
  };

  // Done when every row is in the page, or cannot be; true where some came. After the first picture of the page, which is
  // what one waits for.
  const whole = new Promise((done) => {
    document.addEventListener('DOMContentLoaded', () => {
      const failures = document.getElementById('failures');
      const rest = document.getElementById('rest');
      if (!rest) { done(false); return; }
      setTimeout(() => loadAll(failures, rest).catch(() => tellMissing(rest)).finally(() => done(true)));
    });
  });

  // Pictures of causes in a page that contains everything: those of the cards, so that none is in the page twice.
  document.addEventListener('DOMContentLoaded', () => {
    for (const image of document.querySelectorAll('.thumb img[data-picture-of]')) {
      const picture = document.getElementById(`case=${image.dataset.pictureOf}`)?.querySelector('.strip img');
      if (picture) image.src = picture.src;
    }
  });

  // A card as it stands on the page, read once; without the buttons that live.js adds.
  let texts = new WeakMap();
  const textOf = (card) => {
    if (texts.has(card)) return texts.get(card);
    const copied = card.cloneNode(true);
    for (const bar of copied.querySelectorAll('.live-bar')) bar.remove();
    texts.set(card, copied.textContent.toLowerCase());
    return texts.get(card);
  };
  const forgetTexts = () => { texts = new WeakMap(); };

  window.contortPage = { load, whole, textOf, forgetTexts };
})();
