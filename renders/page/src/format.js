// Numbers as the page and the command line write them.

const kDegrees = 180 / Math.PI;
const kFamiliar = {
  rad: ['\u00b0', kDegrees], 'rad/s': ['\u00b0/s', kDegrees], 'rad/s^2': ['\u00b0/s^2', kDegrees], m: [' mm', 1000],
};

// A whole number with narrow no-break spaces between thousands.
export function count(value) {
  return String(value).replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

// At most three significant digits, and an exponent only below 0.001 and from a million on. rounded_text in
// renders/wording.h is its twin.
export function number(value) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'not a number' : `${value < 0 ? '-' : ''}infinite`;
  if (value === 0) return '0';
  const [digits, exponent] = value.toExponential(2).split('e').map(Number);
  if (exponent < -3 || exponent >= 6) return `${digits}e${exponent}`;
  const plain = Number(value.toPrecision(3));
  return exponent >= 3 ? count(plain) : String(plain);
}

export function margin(value, unit) {
  if (!Number.isFinite(value)) return 'not a number';
  const plain = `${number(value)} ${unit}`.trim();
  const familiar = kFamiliar[unit];
  return familiar ? `${plain} (${number(value * familiar[1])}${familiar[0]})` : plain;
}

export function seconds(frame, rate) {
  return `${(frame / rate).toFixed(3)} s`;
}

// A unit such as "of its strength" is a share.
export function marginName(unit) {
  if (!unit) return 'margin';
  return unit.startsWith('of ') ? `margin as a share ${unit}` : `margin in ${unit}`;
}

// "frame 12", "frames 12\u201315", "" where there is none
export function interval(first, last) {
  if (first < 0 || last < first) return '';
  return first === last ? `frame ${first}` : `frames ${first}\u2013${last}`;
}

// "frames 3\u20135 and 9", "4 times: frames 3, 5\u20136, 9 and 12"; of many only the first ones.
export function intervals(runs) {
  if (runs.length === 0) return '';
  if (runs.length === 1) return interval(runs[0].first, runs[0].last);
  const texts = runs.slice(0, 12).map(({ first, last }) => (first === last ? `${first}` : `${first}\u2013${last}`));
  if (runs.length > 12) texts.push(`${runs.length - 12} more`);
  return `${runs.length} times: frames ${texts.slice(0, -1).join(', ')} and ${texts.at(-1)}`;
}

export const kRoleNames = { minimal: 'Minimal', original: 'Original', worst: 'Worst seen', changed: 'With your values' };

export function roleName(role) {
  return Object.hasOwn(kRoleNames, role) ? kRoleNames[role] : role || 'Motion';
}
