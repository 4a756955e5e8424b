// Puts a new report in the place of the one that is shown, without loading the page: filters, focus, forms that are
// being filled in, what is unfolded and the open case stay.

// The server's own page, as it would be shown after loading it anew. The one place where a text becomes markup: what is
// in it from other people was escaped when it was written, and a parsed document runs nothing. Its styles and scripts
// are left out: they carry another nonce than this page's.
async function fetchDocument(address) {
  const answer = await fetch(address, { cache: 'no-cache' });
  if (!answer.ok) throw new Error(`the server answered ${answer.status}`);
  const text = (await answer.text()).replace(/<(style|script)\b[^]*?<\/\1>/g, '');
  return new DOMParser().parseFromString(text, 'text/html');
}

const bucketsOf = (place) => [...place.querySelectorAll('.bucket[data-case]')];
const keysOf = (place) => bucketsOf(place).map((bucket) => bucket.dataset.case);

// Equal for cards that show the same.
function fingerprint(card) {
  const pictures = [...card.querySelectorAll('img, .moving')]
    .map((one) => one.getAttribute('src') ?? one.getAttribute('href'));
  return JSON.stringify([{ ...card.dataset }, card.className, card.textContent, pictures]);
}

const count = (number, one, many) => `${number} ${number === 1 ? one : many}`;

export class Refresh {
  constructor() {
    this.known = new WeakMap();
    for (const card of document.querySelectorAll('.card')) this.known.set(card, fingerprint(card));
  }

  // `barOf(key)` gives the element that goes along with a bucket. Returns what is to be told.
  async run(barOf) {
    const fresh = await fetchDocument(location.pathname + location.search);
    const failures = document.getElementById('failures');
    const next = fresh.getElementById('failures');
    if (!failures || !next) throw new Error('it is no report');
    // The list of a report so long that further rows come from files is made by loading the page.
    if (fresh.getElementById('rest')) return this.loadAnew();
    const before = new Set(keysOf(failures));
    const after = keysOf(next);
    const anchor = this.anchor();
    this.replaceRest(fresh);
    this.replaceList(failures, next, barOf);
    document.dispatchEvent(new CustomEvent('contort:list'));
    this.restore(anchor);
    const added = after.filter((key) => !before.has(key)).length;
    const gone = [...before].filter((key) => !after.includes(key)).length;
    return ['Report updated', added ? count(added, 'new failure', 'new failures') : 'no new failure',
      gone ? `${gone} gone` : ''].filter(Boolean).join(', ').replace(', ', ': ');
  }

  // Loads the page again, but not while somebody looks at a case or writes.
  loadAnew() {
    const busy = document.documentElement.classList.contains('case-open') || document.querySelector('.live-bar form');
    if (!busy) location.reload();
    return busy ? 'Report updated: load the page again to see it' : 'Report updated';
  }

  // The element that the reader looks at, and its place on the screen.
  anchor() {
    const focused = document.activeElement?.closest('.card, form') ? document.activeElement : null;
    const seen = focused?.closest('.card') ??
      [...document.querySelectorAll('.card')].find((card) => card.getBoundingClientRect().bottom > 0);
    return {
      focused, key: focused?.closest('.bucket')?.dataset.case, look: focused?.className.split(' ')[0],
      seen: seen && keysOf(seen)[0], top: seen?.getBoundingClientRect().top ?? 0,
    };
  }

  restore({ focused, key, look, seen, top }) {
    const bucketOf = (name) => bucketsOf(document).find((bucket) => bucket.dataset.case === name);
    if (focused && document.activeElement !== focused) {
      const twin = key && look ? bucketOf(key)?.querySelector(`.${CSS.escape(look)}`) : null;
      const to = focused.isConnected ? focused : twin ?? (key && bucketOf(key)?.closest('.card'));
      to?.focus({ preventScroll: true });
    }
    const card = seen && bucketOf(seen)?.closest('.card');
    if (card && !document.documentElement.classList.contains('case-open'))
      scrollBy(0, card.getBoundingClientRect().top - top);
  }

  // Verdict, statistics, footer: nothing there is being edited.
  replaceRest(fresh) {
    if (!document.documentElement.classList.contains('case-open')) document.title = fresh.title;
    for (const selector of ['header.verdict', 'footer']) {
      const [old, next] = [document.querySelector(selector), fresh.querySelector(selector)];
      if (old && next) old.replaceWith(document.adoptNode(next));
    }
    const main = document.querySelector('main.page');
    const failures = document.getElementById('failures');
    for (const old of [...main.children]) if (old !== failures) old.remove();
    // Those above the failures stay above them.
    const all = [...fresh.querySelector('main.page').children];
    const place = all.findIndex((next) => next.id === 'failures');
    failures.before(...all.slice(0, place).map((next) => document.adoptNode(next)));
    failures.after(...all.slice(place + 1).map((next) => document.adoptNode(next)));
  }

  replaceList(failures, next, barOf) {
    const form = failures.querySelector('.filter');
    // If the old or the new report has no failures, there is no state to keep.
    if (!form || !next.querySelector('.filter')) {
      failures.replaceWith(document.adoptNode(next));
      this.remember(next);
      return;
    }
    const old = new Map([...failures.querySelectorAll('.card')]
      .flatMap((card) => keysOf(card).map((key) => [key, card])));
    const unused = new Set(old.values());
    let at = failures.querySelector('.card') ?? failures.querySelector('#no-match');
    for (const card of [...next.querySelectorAll('.card')]) {
      const twin = keysOf(card).map((key) => old.get(key)).find((one) => unused.has(one));
      unused.delete(twin);
      const place = this.chosen(twin, card, barOf);
      if (twin && twin === at && place !== twin) { at = at.nextElementSibling; twin.remove(); }
      else if (twin && place !== twin) twin.remove();
      if (place === at) at = at.nextElementSibling;
      else failures.insertBefore(place, at);
    }
    for (const card of unused) card.remove();
  }

  // The old card where it shows the same; else the new one with what belongs to the reader.
  chosen(twin, card, barOf) {
    const mark = fingerprint(card);
    if (twin && this.known.get(twin) === mark) return twin;
    const fresh = document.adoptNode(card);
    this.known.set(fresh, mark);
    if (twin) {
      const folds = [...twin.querySelectorAll('details')];
      [...fresh.querySelectorAll('details')].forEach((fold, i) => { fold.open = folds[i]?.open ?? false; });
      const theirs = new Set(keysOf(twin));
      for (const bucket of bucketsOf(fresh))
        if (theirs.has(bucket.dataset.case)) bucket.append(barOf(bucket.dataset.case));
    }
    return fresh;
  }

  remember(place) {
    for (const card of place.querySelectorAll('.card')) this.known.set(card, fingerprint(card));
  }
}
