// The report's own script: filter, keys, copying, opening a case. Without it the page is complete but for these.
// It runs in the head, before the body is there. Texts are set with textContent only.
(() => {
  'use strict';
  const { load, whole, textOf, forgetTexts } = window.contortPage;  // rows.js
  const root = document.documentElement;
  root.classList.add('js');

  // ---- pictures that are missing

  // This script is in the head, so that it listens before the first picture can fail.
  document.addEventListener('error', (event) => {
    if (event.target.closest?.('.thumb')) { event.target.remove(); return; }
    const text = event.target.dataset && event.target.dataset.missing;
    if (!text) return;
    const note = document.createElement('p');
    note.className = 'missing';
    note.textContent = text;
    const moving = event.target.closest('.bucket')?.querySelector('.moving');
    if (moving) moving.remove();  // It is drawn together with the strip.
    event.target.closest('.strip').replaceWith(note);
  }, true);

  // ---- copying: the text before a button of class "copy"

  const copyOldWay = (text) => {
    const area = document.createElement('textarea');
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand('copy');
    area.remove();
    return done;
  };
  const copy = async (text) => {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch {
      return copyOldWay(text);
    }
  };
  document.addEventListener('click', async (event) => {
    const button = event.target.closest('.copy');
    if (!button) return;
    const done = await copy(button.previousElementSibling.textContent);
    button.focus();
    button.textContent = done ? 'Copied' : 'Selected';
    if (!done) getSelection().selectAllChildren(button.previousElementSibling);
    setTimeout(() => { button.textContent = 'Copy'; }, 1600);
  });

  // ---- the address: #case=KEY&frame=N&q=WORDS&check=...

  const address = {
    read: () => new URLSearchParams(location.hash.slice(1)),
    // Empty values are left out. Some browsers refuse this on pages from a disk, or when it is done too often: then the
    // address only does not keep what is shown.
    write(values) {
      const state = new URLSearchParams();
      for (const [name, value] of Object.entries(values)) if (value !== '' && value !== null) state.set(name, value);
      const text = state.toString();
      if (text === location.hash.slice(1)) return;
      try {
        history.replaceState(null, '', `${location.pathname}${location.search}${text ? `#${text}` : ''}`);
      } catch { /* See above. */ }
    },
  };

  // ---- filter

  // Name in the address and in words: element, attribute of the cards.
  const kSelects = ['check', 'character', 'part', 'phase', 'state'];
  const kWord = /^(check|character|part|slot|phase|state):(.*)$/;

  const attributeOf = (card, name) =>
    (name === 'part' || name === 'slot' ? card.dataset.parts : card.dataset[name]) || '';
  // Checks have no spaces; the other attributes are words with spaces between.
  const valuesOf = (card, name) => attributeOf(card, name).split(' ').filter(Boolean);

  const list = { cards: [], words: null, selects: new Map() };

  // A value that was chosen stays chosen while there is such a failure.
  const fillSelect = (name, select) => {
    const values = new Set(list.cards.flatMap((card) => valuesOf(card, name)));
    const chosen = select.value;
    select.replaceChildren(new Option(`all ${name}s`, ''), ...[...values].sort().map((value) => new Option(value, value)));
    select.value = values.has(chosen) ? chosen : '';
    // A choice of one is none.
    if (select.closest('label')) select.closest('label').hidden = values.size < 2;
  };

  const matches = (card, word) => {
    const [, name, value] = kWord.exec(word) || [];
    return name ? attributeOf(card, name).toLowerCase().includes(value) : textOf(card).includes(word);
  };

  const apply = () => {
    const words = list.words.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const card of list.cards) {
      let fits = words.every((word) => matches(card, word));
      for (const [name, select] of list.selects)
        fits = fits && (!select.value || valuesOf(card, name).includes(select.value));
      if (card.hidden === fits) card.hidden = !fits;
      shown += fits ? 1 : 0;
    }
    document.getElementById('shown').textContent = `${shown} of ${list.cards.length} kinds of failure shown`;
    document.getElementById('no-match').hidden = shown > 0;
  };

  const filterState = () => {
    const state = { q: list.words ? list.words.value : '' };
    for (const [name, select] of list.selects) state[name] = select.value;
    return state;
  };

  const readFilter = () => {
    const state = address.read();
    list.words.value = state.get('q') || '';
    for (const [name, select] of list.selects) {
      select.value = state.get(name) || '';
      if (select.selectedIndex < 0) select.value = '';
    }
    apply();
  };

  const startFilter = () => {
    list.words = document.getElementById('words');
    if (!list.words) return;
    for (const name of kSelects) {
      const select = document.getElementById(name);
      if (!select) continue;
      list.selects.set(name, select);
      fillSelect(name, select);
    }
    const change = () => { apply(); address.write(filterState()); };
    list.words.addEventListener('input', change);
    for (const select of list.selects.values()) select.addEventListener('change', change);
    list.words.form.addEventListener('submit', (event) => event.preventDefault());
    list.words.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') { list.words.value = ''; change(); list.words.blur(); }
    });
    readFilter();
  };

  // Rows that came later.
  const takeRows = () => {
    if (!list.words) return;
    list.cards = [...document.querySelectorAll('.card')];
    forgetTexts();
    for (const [name, select] of list.selects) fillSelect(name, select);
    readFilter();
  };

  // ---- loading a case

  let viewerLoading = null;
  const viewer = async () => {
    if (window.contortViewer) return window.contortViewer;
    viewerLoading = viewerLoading || Promise.all([
      load('link', { rel: 'stylesheet', href: 'viewer/viewer.css' }), load('script', { src: 'viewer/viewer.js' })]);
    try {
      await viewerLoading;
    } catch {
      viewerLoading = null;
    }
    if (!window.contortViewer)
      throw new Error('The viewer cannot be loaded: the folder viewer next to this page is missing or damaged.');
    return window.contortViewer;
  };

  // The files of cases and strips call this. What nobody waits for is dropped.
  const waiting = new Map();
  window.contortCase = window.contortStrip = (name, data) => { if (waiting.has(name)) waiting.set(name, data); };

  const dataFromPage = (element, what) => {
    try {
      return JSON.parse(element.textContent);
    } catch {
      throw new Error(`The data of ${what} in this page is damaged.`);
    }
  };

  const dataFromFile = async (file, name) => {
    waiting.set(name, null);
    try {
      (await load('script', { src: file })).remove();
    } catch {
      throw new Error(`The file ${file} is missing: it has to be next to this page.`);
    }
    const data = waiting.get(name);
    waiting.delete(name);
    if (!data) throw new Error(`The file ${file} is damaged.`);
    return data;
  };

  const caseData = (key) => {
    const element = document.getElementById(`case-${key}`);
    return element ? dataFromPage(element, `case ${key}`) : dataFromFile(`cases/${encodeURIComponent(key)}.js`, key);
  };

  // The film strip of a case that has one: its picture, and a function that loads the views of its tiles.
  const stripOf = (data) => {
    const [path, name] = /^strips\/([\w.-]+)\.png$/.exec(data.strip) || [];
    if (!path) return {};
    const element = document.getElementById(`strip-${name}`);
    const stripViews = async () =>
      (element ? dataFromPage(element, 'the film strip') : dataFromFile(`strips/${encodeURIComponent(name)}.js`, name));
    return { picture: { src: path, alt: 'Film strip' }, stripViews };
  };

  // ---- the open case

  const shown = { key: '', view: null, panel: null, ticket: null, addressTimer: 0, title: '' };
  const buckets = () => [...document.querySelectorAll('.bucket[data-case]')];
  const bucketOf = (key) => buckets().find((bucket) => bucket.dataset.case === key);
  const isListed = (bucket) => !bucket.closest('.card') || !bucket.closest('.card').hidden;

  // A sentence where the reader asked: in the bucket, or above the list.
  const say = (place, text) => {
    const old = place.querySelector(':scope > .problem');
    if (old) old.remove();
    if (!text) return;
    const note = document.createElement('p');
    note.className = 'problem';
    note.setAttribute('role', 'alert');
    note.textContent = text;
    place.prepend(note);
    note.scrollIntoView({ block: 'nearest' });
  };

  const rememberFrame = (key, frame) => {
    clearTimeout(shown.addressTimer);
    // The address does not change at each step of a drag, because browsers limit such changes.
    shown.addressTimer = setTimeout(() => {
      if (shown.key === key) address.write({ case: key, frame, ...filterState() });
    }, 150);
  };

  const reveal = (element) => {
    for (let at = element.closest('details'); at; at = at.parentElement.closest('details')) at.open = true;
  };

  const showList = (key) => {
    clearTimeout(shown.addressTimer);
    root.classList.remove('case-open');
    if (shown.panel) shown.panel.hidden = true;
    if (shown.title) document.title = shown.title;
    Object.assign(shown, { key: '', view: null, ticket: null });
    address.write(filterState());
    const bucket = bucketOf(key);
    if (!bucket) return;
    reveal(bucket);
    const button = bucket.querySelector('.open');
    (button || bucket.closest('.card')).focus({ preventScroll: true });
    (button || bucket).scrollIntoView({ block: 'center' });
  };

  const closeCase = () => {
    if (!shown.key) return;
    if (window.contortViewer) window.contortViewer.close();
    showList(shown.key);
  };

  const panel = () => {
    if (shown.panel) return shown.panel;
    shown.panel = document.createElement('main');
    shown.panel.id = 'case';
    shown.panel.className = 'case-view';
    document.body.prepend(shown.panel);
    return shown.panel;
  };

  const optionsFor = (key, bucket, frame, data) => {
    const ways = buckets().filter((other) => other === bucket || isListed(other));
    const at = ways.indexOf(bucket);
    const go = (other) => (other ? () => openCase(other.dataset.case, null) : null);
    const image = bucket.querySelector('.strip img');
    const command = bucket.querySelector('.command code');
    return {
      frame: frame === null ? undefined : frame,
      onFrame: (now) => rememberFrame(key, now),
      onClose: () => showList(key),
      onPrevious: go(ways[at - 1]), onNext: go(ways[at + 1]),
      position: `${at + 1} of ${ways.length}`,
      ...stripOf(data), ...(image && { picture: { src: image.currentSrc || image.src, alt: image.alt } }),
      command: command ? command.textContent : '',
      loadEngine: 'engine' in root.dataset && ((src) => load('script', { src })),
    };
  };

  const failed = (key, bucket, text) => {
    if (window.contortViewer) window.contortViewer.close();
    const wasOpen = shown.key;
    if (wasOpen) showList(key);
    reveal(bucket);
    say(bucket, text);
  };

  const present = (key, bucket, frame, api, data) => {
    shown.key = key;
    panel().hidden = false;
    root.classList.add('case-open');
    try {
      shown.view = api.open(shown.panel, data, optionsFor(key, bucket, frame, data));
    } catch (error) {
      throw new Error(`Case ${key} cannot be shown: ${error.message}.`);
    }
    shown.title = shown.title || document.title;
    document.title = `${data.check} ${data.subject} \u2013 ${shown.title}`;
    scrollTo(0, 0);
    document.dispatchEvent(new CustomEvent('contort:case', { detail: { key, element: shown.panel } }));
  };

  const openCase = async (key, frame) => {
    const failures = document.getElementById('failures') || document.body;
    const ticket = shown.ticket = {};
    if (!bucketOf(key)) await whole;
    if (shown.ticket !== ticket) return;  // Another one was opened meanwhile.
    const bucket = bucketOf(key);
    if (!bucket) {
      if (shown.key) closeCase();
      say(failures, `This report has no case ${key}.`);
      return;
    }
    say(failures, '');
    say(bucket, '');
    const button = bucket.querySelector('.open');
    if (button) button.setAttribute('aria-busy', 'true');
    try {
      const [api, data] = await Promise.all([viewer(), caseData(key)]);
      if (shown.ticket === ticket) present(key, bucket, frame, api, data); 
    } catch (error) {
      if (shown.ticket === ticket) failed(key, bucket, error.message);
    } finally {
      if (button) button.removeAttribute('aria-busy');
    }
  };

  const readAddress = () => {
    const state = address.read();
    const key = state.get('case');
    const frame = /^\d{1,9}$/.test(state.get('frame') || '') ? Number(state.get('frame')) : null;
    if (!key) closeCase();
    else if (key !== shown.key) openCase(key, frame);
    else if (frame !== null && shown.view) shown.view.player.seek(frame);
  };

  // ---- keys of the list; an open case has its own

  const moveFocus = (way) => {
    const visible = list.cards.filter((card) => !card.hidden);
    const at = visible.indexOf(document.activeElement.closest('.card'));
    const next = visible[way > 0 ? at + 1 : Math.max(0, at - 1)];
    if (next) { next.focus({ preventScroll: true }); next.scrollIntoView(); }
  };

  const listKey = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (root.classList.contains('case-open') || event.target.matches('input, select, textarea')) return;
    if (event.key === '/' && list.words) { event.preventDefault(); list.words.focus(); list.words.select(); }
    if (event.key === 'j') moveFocus(1);
    if (event.key === 'k') moveFocus(-1);
    if (event.key !== 'Enter' || !event.target.matches('.card')) return;
    const bucket = event.target.querySelector('.bucket[data-case]');
    if (bucket) openCase(bucket.dataset.case, null);
  };

  // live.js has changed the list: a server made the report anew.
  const relist = () => {
    list.cards = [...document.querySelectorAll('.card')];
    if (list.words !== document.getElementById('words')) { list.selects.clear(); startFilter(); return; }
    for (const [name, select] of list.selects) fillSelect(name, select);
    if (list.words) apply();
  };

  document.addEventListener('DOMContentLoaded', () => {
    list.cards = [...document.querySelectorAll('.card')];
    startFilter();
    document.addEventListener('contort:list', relist);
    document.addEventListener('keydown', listKey);
    document.addEventListener('click', (event) => {
      const button = event.target.closest('.open');
      const bucket = button && button.closest('.bucket[data-case]');
      if (bucket) openCase(bucket.dataset.case, null);
    });
    window.addEventListener('hashchange', () => {
      if (location.hash && !location.hash.includes('=')) return;  // A place in the page, such as #failures.
      if (list.words) readFilter();
      readAddress();
    });
    if (address.read().get('case')) readAddress();
    whole.then((came) => { if (came) takeRows(); });
  });
})();
