// Elements without markup strings: names from other people's files reach the page only as text.

const kSvg = 'http://www.w3.org/2000/svg';

// el('button', {class: 'x', text: 'Play', on: {click}, 'aria-pressed': 'true'}, child, ...)
export function el(tag, options = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(options)) {
    if (value === undefined || value === null || value === false) continue;
    if (name === 'text') element.textContent = value;
    else if (name === 'on') for (const [kind, call] of Object.entries(value)) element.addEventListener(kind, call);
    else element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

// Outlines in a square of 16 units, filled with the text's colour.
const kIcons = {
  play: 'M4 2v12l10-6z',
  pause: 'M3 2h4v12H3zM9 2h4v12H9z',
  back: 'M2 2h3v12H2zM14 2v12L6 8z',
  forward: 'M11 2h3v12h-3zM2 2v12l8-6z',
  plus: 'M7 2h2v5h5v2H9v5H7V9H2V7h5z',
  minus: 'M2 7h12v2H2z',
  left: 'M11 1v14L3 8z',
  right: 'M5 1v14l8-7z',
};

export function icon(name) {
  const svg = document.createElementNS(kSvg, 'svg');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('aria-hidden', 'true');
  svg.setAttribute('class', 'icon');
  const path = document.createElementNS(kSvg, 'path');
  path.setAttribute('d', kIcons[name]);
  svg.append(path);
  return svg;
}

// A button with a visible text; `key` is told in the tooltip.
export function textButton(text, key, click, more = {}) {
  return el('button', {
    type: 'button', text, title: key ? `Key ${key}` : null, 'aria-keyshortcuts': key || null, on: { click }, ...more,
  });
}

// A button that shows only a picture; `name` is what it does.
export function iconButton(picture, name, key, click, more = {}) {
  const button = el('button', {
    type: 'button', class: 'icon-only', 'aria-label': name, title: key ? `${name} (key ${key})` : name,
    'aria-keyshortcuts': key || null, on: { click }, ...more,
  });
  button.append(icon(picture));
  return button;
}

export function setPressed(button, pressed) {
  button.setAttribute('aria-pressed', pressed ? 'true' : 'false');
}
