// The fixed parts of the report page. Everything is inline: no request leaves the page, and it works from file://.
#pragma once

namespace contort::page {

inline constexpr char kStyle[] = R"css(
:root {
  --paper: #f6f7f9; --card: #ffffff; --ink: #1b2129; --dim: #586473; --line: #dde2e8; --field: #ffffff;
  --code: #f1f3f6; --accent: #0b5cad; --bad: #b3261e; --bad-ink: #ffffff; --good: #1a6f3c; --idle: #8a5a00;
  --alarm: #b3261e; --chip: #e7ebf0; --chip-ink: #3b4652; --bar: #9db4cc;
  --mono: ui-monospace, "SF Mono", "Cascadia Mono", "DejaVu Sans Mono", Menlo, Consolas, monospace;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #12161b; --card: #1a2027; --ink: #e4e8ed; --dim: #9aa6b4; --line: #2c343e; --field: #12161b;
    --code: #12161b; --accent: #7ab7ff; --bad: #8f1d18; --good: #175c34; --idle: #6e4a06;
    --alarm: #ff9389; --chip: #2b343f; --chip-ink: #c5ced8; --bar: #41566d;
  }
}
* { box-sizing: border-box; }
html { scroll-padding-top: 1rem; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif;
  overflow-wrap: anywhere;
}
.page { max-width: 1120px; margin: 0 auto; padding: 0 1.25rem; }
h1, h2, h3, p, dl, dd, pre { margin: 0; }
a { color: var(--accent); }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; border-radius: 3px; }
.skip { position: absolute; left: -100rem; }
.skip:focus { left: 1rem; top: 1rem; padding: .5rem 1rem; background: var(--card); z-index: 1; }
.unseen { position: absolute; clip-path: inset(50%); width: 1px; height: 1px; overflow: hidden; white-space: nowrap; }

.verdict { color: var(--bad-ink); padding: 1.75rem 0 1.5rem; }
.verdict.bad { background: var(--bad); }
.verdict.good { background: var(--good); }
.verdict.idle { background: var(--idle); }
.verdict .title { font-size: .9375rem; font-weight: 600; opacity: .9; }
.verdict h1 { font-size: clamp(2rem, 6vw, 3rem); line-height: 1.15; letter-spacing: -.02em; margin: .15rem 0 .35rem; }
.verdict .detail { opacity: .95; max-width: 46rem; }
.numbers { display: flex; flex-wrap: wrap; gap: .5rem 2.25rem; margin-top: 1.25rem; }
.numbers div { display: flex; flex-direction: column-reverse; }
.numbers dt { font-size: .8125rem; opacity: .85; }
.numbers dd {
  font-size: 1.25rem; font-weight: 600; font-variant-numeric: tabular-nums; line-height: 1.3; white-space: nowrap;
}

h2 { font-size: 1.25rem; letter-spacing: -.01em; margin: 2rem 0 .75rem; }
.filter { display: none; gap: .75rem 1rem; align-items: end; flex-wrap: wrap; margin-bottom: 1rem; }
.js .filter { display: flex; }
.filter label { display: flex; flex-direction: column; font-size: .8125rem; color: var(--dim); gap: .2rem; }
.filter .words { flex: 1 1 16rem; }
.filter input, .filter select {
  font: inherit; font-size: 1rem; color: var(--ink); background: var(--field);
  border: 1px solid var(--line); border-radius: 6px; padding: .4rem .6rem; min-height: 2.5rem; max-width: 100%;
}
.filter input::placeholder { color: var(--dim); opacity: .75; }
.filter output { color: var(--dim); font-size: .875rem; padding-bottom: .55rem; font-variant-numeric: tabular-nums; }

.card {
  background: var(--card); border: 1px solid var(--line); border-left: 4px solid var(--chip);
  border-radius: 8px; padding: 1rem 1.25rem 1.1rem; margin-bottom: 1rem;
  content-visibility: auto; contain-intrinsic-size: auto 780px;
}
.card.gating { border-left-color: var(--alarm); }
.card[hidden] { display: none; }
.head { display: flex; flex-wrap: wrap; gap: .35rem 1rem; justify-content: space-between; align-items: baseline; }
h3 { font-size: 1.0625rem; font-weight: 600; font-family: var(--mono); letter-spacing: -.01em; line-height: 1.4; }
h3 .check { color: var(--alarm); margin-right: .4rem; }
.card:not(.gating) h3 .check { color: var(--dim); }
.summary { color: var(--dim); font-size: .875rem; font-variant-numeric: tabular-nums; }
.chip {
  display: inline-block; border-radius: 999px; padding: .05rem .6rem; margin-right: .3rem; font-weight: 600;
  font-size: .8125rem; background: var(--chip); color: var(--chip-ink);
}
.state-new, .state-regressed { background: #b3261e; color: #fff; }
.state-open { background: #ffe2ad; color: #5a3b00; }
.state-quarantined { background: #ddd3f5; color: #3d2a70; }
.state-flaky { background: #cfe3fb; color: #123f70; }
.state-fixed { background: #cdebd7; color: #0e4a26; }

.bucket { margin-top: .8rem; }
details .bucket { border-top: 1px solid var(--line); padding-top: .8rem; }
.strip { overflow-x: auto; border-radius: 6px; background: #181d24; }
.strip a { display: block; min-width: 44rem; }
.strip img {
  display: block; width: 100%; height: auto; aspect-ratio: auto 1290 / 542; color: #cfd6de; font-size: .875rem;
}
html:not(.js) .strip img { aspect-ratio: auto; }  /* A missing picture is one line of text then. */
.missing {
  background: var(--code); border: 1px dashed var(--line); border-radius: 6px; color: var(--dim);
  padding: 1.1rem 1rem; font-family: var(--mono); font-size: .8125rem;
}
.facts { display: flex; flex-wrap: wrap; gap: .6rem 2.25rem; margin: .9rem 0; }
.facts dt { font-size: .8125rem; color: var(--dim); }
.facts dd { font-size: .9375rem; font-variant-numeric: tabular-nums; line-height: 1.4; }
.command {
  display: flex; align-items: stretch; border: 1px solid var(--line); border-radius: 6px; background: var(--code);
  overflow: hidden;
}
.command code { flex: 1; min-width: 0; padding: .55rem .75rem; font: .8125rem/1.5 var(--mono); }
.copy {
  display: none; flex: none; width: 5.5rem; border: 0; border-left: 1px solid var(--line); background: var(--card);
  color: var(--accent); font: 600 .875rem/1 system-ui, sans-serif; cursor: pointer;
}
.js .copy { display: block; }
.copy:hover { background: var(--chip); }
.copy:focus-visible { outline-offset: -3px; }
details { margin-top: .7rem; }
summary { cursor: pointer; font-weight: 600; font-size: .9375rem; width: fit-content; }
details > :nth-child(2) { margin-top: .6rem; }
pre {
  background: var(--code); border: 1px solid var(--line); border-radius: 6px; padding: .75rem; overflow: auto;
  max-height: 28rem; font: .8125rem/1.5 var(--mono); overflow-wrap: normal;
}
.none { color: var(--dim); padding: .5rem 0; }

table { border-collapse: collapse; width: 100%; font-size: .9375rem; }
th { text-align: left; font-weight: 400; }
thead th { color: var(--dim); font-size: .8125rem; }
td { font-variant-numeric: tabular-nums; text-align: right; }
th, td { padding: .3rem .75rem .3rem 0; border-bottom: 1px solid var(--line); }
td:last-child, thead th:last-child { width: 45%; padding-right: 0; }
thead th:nth-child(2) { text-align: right; }
.never { color: var(--alarm); }
.bar { display: block; width: 100%; height: .6rem; }
.bar rect { fill: var(--bar); }

.curve { margin: 1rem 0; }
.curve figcaption { color: var(--dim); font-size: .8125rem; }
.curve svg { display: block; width: 100%; height: 8rem; }
.curve svg { border: solid var(--line); border-width: 0 0 1px 1px; }
.curve path { fill: none; stroke: var(--accent); stroke-width: 2; vector-effect: non-scaling-stroke; }
table.arms td, table.arms thead th { width: auto; padding-right: .75rem; }
table.arms thead th:not(:first-child) { text-align: right; }

footer { color: var(--dim); font-size: .875rem; padding-top: 1.5rem; padding-bottom: 2.5rem; }
.keys { display: none; }
.js .keys { display: inline; }
kbd {
  font: .8125rem var(--mono); border: 1px solid var(--line); border-radius: 4px; padding: 0 .35rem;
  background: var(--card);
}

@media (max-width: 560px) {
  .page { padding: 0 1rem; }
  .card { padding: .85rem .9rem 1rem; }
  .numbers { gap: .6rem 1.5rem; }
  .numbers dd { font-size: 1.125rem; }
  .facts { display: grid; grid-template-columns: 1fr 1fr; gap: .6rem 1rem; }
  td:last-child, thead th:last-child { width: 30%; }
}
@media print {
  .filter, .copy, .skip, .keys { display: none !important; }
  .card { break-inside: avoid; content-visibility: visible; }
  .strip a { min-width: 0; }
  .verdict { color: #000; background: none !important; }
}
)css";

inline constexpr char kScript[] = R"js(
(() => {
  'use strict';
  document.documentElement.classList.add('js');

  // In the head, so that it is listening before the first picture can fail.
  document.addEventListener('error', (event) => {
    const text = event.target.dataset && event.target.dataset.missing;
    if (!text) return;
    const note = document.createElement('p');
    note.className = 'missing';
    note.textContent = text;
    event.target.closest('.strip').replaceWith(note);
  }, true);

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

  document.addEventListener('DOMContentLoaded', () => {
    const cards = [...document.querySelectorAll('.card')];
    const words = document.getElementById('words');
    const check = document.getElementById('check');
    if (!words) return;

    const matches = (card, word) => {
      const [, key, value] = /^(check|state):(.*)$/.exec(word) || [];
      return key ? card.dataset[key].toLowerCase().includes(value) : card.dataset.text.includes(word);
    };
    const apply = () => {
      const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const card of cards) {
        const of_check = !check.value || card.dataset.check === check.value;
        const fits = of_check && wanted.every((word) => matches(card, word));
        card.hidden = !fits;
        shown += fits ? 1 : 0;
      }
      document.getElementById('shown').textContent = `${shown} of ${cards.length} shown`;
      document.getElementById('no-match').hidden = shown > 0;
    };
    const remember = () => {
      const state = new URLSearchParams();
      if (words.value) state.set('q', words.value);
      if (check.value) state.set('check', check.value);
      try {
        history.replaceState(null, '', '#' + state);
      } catch { /* Only a convenience: the address then does not keep the filter. */ }
    };
    const change = () => { apply(); remember(); };
    words.addEventListener('input', change);
    check.addEventListener('change', change);
    words.form.addEventListener('submit', (event) => event.preventDefault());
    const state = new URLSearchParams(location.hash.slice(1));
    words.value = state.get('q') || '';
    check.value = state.get('check') || '';
    if (check.selectedIndex < 0) check.value = '';
    apply();

    document.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const typing = event.target.matches('input, select, textarea');
      if (event.key === 'Escape' && event.target === words) { words.value = ''; change(); words.blur(); }
      if (typing) return;
      if (event.key === '/') { event.preventDefault(); words.focus(); words.select(); }
      if (event.key !== 'j' && event.key !== 'k') return;
      const visible = cards.filter((card) => !card.hidden);
      const at = visible.indexOf(document.activeElement.closest('.card'));
      const next = visible[event.key === 'j' ? at + 1 : Math.max(0, at - 1)];
      if (next) { next.focus({ preventScroll: true }); next.scrollIntoView(); }
    });
  });
})();
)js";

}  // namespace contort::page
