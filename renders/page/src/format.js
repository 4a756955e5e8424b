// Numbers as the page and the command line write them.

const kFamiliar = { rad: ['\u00b0', 180 / Math.PI], 'rad/s': ['\u00b0/s', 180 / Math.PI], m: [' mm', 1000] };

// Three digits that count.
export function number(value) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e6 || size < 1e-4 ? value.toExponential(2) : String(Number(value.toPrecision(3)));
}

export function margin(value, unit) {
  if (!Number.isFinite(value)) return 'not a number';
  const plain = `${number(value)} ${unit}`.trim();
  const familiar = kFamiliar[unit];
  return familiar ? `${plain} (${(value * familiar[1]).toFixed(1)}${familiar[0]})` : plain;
}

export function seconds(frame, rate) {
  return `${(frame / rate).toFixed(3)} s`;
}

// "frame 12", "frames 12\u201315", "" where there is none
export function interval(first, last) {
  if (first < 0 || last < first) return '';
  return first === last ? `frame ${first}` : `frames ${first}\u2013${last}`;
}

export const kRoleNames = { minimal: 'Minimal', original: 'Original', worst: 'Worst seen' };

export function roleName(role) {
  return Object.hasOwn(kRoleNames, role) ? kRoleNames[role] : role || 'Motion';
}
