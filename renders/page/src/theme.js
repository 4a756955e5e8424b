// Colours that canvases need, in light and dark. What the style sheet can reach is in viewer.css.

const kLight = {
  dark: false,
  stage: '#e3e8ee', ground: '#b4bec9', line: '#8492a2', majorLine: '#5b6978', obstacle: '#a08c68',
  ghost: '#5d6a78', red: '#d2271b', orange: '#c96a00', collider: '#1f6fc0', bone: '#3b4a5b',
  good: '#1a7f45', arrow: '#a3178f',
  ink: '#1b2129', dim: '#586473', grid: '#e3e7ec', curve: '#0b5cad', limit: '#b3261e',
  bad: 'rgba(211, 39, 27, .13)', during: 'rgba(211, 39, 27, .10)',
  // margin / scale: -1 and less, just below 0, just above 0, 1 and more
  heat: [[122, 12, 10], [224, 72, 52], [247, 205, 120], [233, 239, 244]],
};

const kDark = {
  dark: true,
  stage: '#39434f', ground: '#2c343e', line: '#4d5968', majorLine: '#71819a', obstacle: '#8d7b5c',
  ghost: '#c3ccd6', red: '#ff5a4a', orange: '#ffa63d', collider: '#7ab7ff', bone: '#d5dde6',
  good: '#5fd08d', arrow: '#ff8df0',
  ink: '#e4e8ed', dim: '#9aa6b4', grid: '#2a323b', curve: '#7ab7ff', limit: '#ff9389',
  bad: 'rgba(255, 90, 74, .16)', during: 'rgba(255, 90, 74, .12)',
  heat: [[255, 96, 80], [176, 46, 36], [140, 104, 40], [44, 54, 64]],
};

const kQuery = '(prefers-color-scheme: dark)';

export function theme() {
  return matchMedia(kQuery).matches ? kDark : kLight;
}

// Returns a function that stops listening.
export function onThemeChange(call) {
  const query = matchMedia(kQuery);
  query.addEventListener('change', call);
  return () => query.removeEventListener('change', call);
}

const mix = (a, b, t) => a.map((value, i) => Math.round(value + (b[i] - value) * t));

// Colour of a margin in units of its scale. The step at 0 is sharp: that is the limit.
export function heatColour(colours, ratio) {
  const [worst, bad, near, safe] = colours.heat;
  const mixed = ratio < 0 ? mix(bad, worst, Math.min(1, -ratio)) : mix(near, safe, Math.min(1, ratio));
  return `rgb(${mixed.join(', ')})`;
}
