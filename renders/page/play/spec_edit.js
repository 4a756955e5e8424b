// The facts about a spec and the catalogue that the forms need. Names of docs/schema/spec.schema.json.
import { list } from '../src/case_data.js';

export const kFormat = 'contort.spec/1';

export function characterEntry(catalogue, spec) {
  return list(catalogue.characters).find((entry) => entry.name === spec?.character?.name) ?? null;
}

// Slot to part, as the spec has it.
export function partsOf(catalogue, spec) {
  const entry = characterEntry(catalogue, spec);
  const chosen = spec?.character?.parts ?? {};
  return new Map(Object.entries(entry?.slots ?? {}).map(([slot, parts]) => [slot, chosen[slot] ?? parts[0]]));
}

// Actions that the part can do: [{...action, params}]
export function actionsOn(catalogue, part) {
  return list(catalogue.actions).filter((action) => Object.hasOwn(action.params_on ?? {}, part))
    .map((action) => ({ ...action, params: list(action.params_on[part]) }));
}

export function socketsOf(catalogue, part) {
  return Object.hasOwn(catalogue.sockets ?? {}, part) ? list(catalogue.sockets[part]) : [];
}

// Sockets that are there, as [value, text] of "slot / socket".
export function socketChoices(catalogue, spec) {
  return [...partsOf(catalogue, spec)].flatMap(([slot, part]) =>
    socketsOf(catalogue, part).map((socket) => [JSON.stringify([slot, socket]), `${slot} / ${socket}`]));
}

export function attachmentsOf(spec) {
  return list(spec?.character?.attachments);
}

export function loadsOf(spec) {
  return list(spec?.dynamics?.loads);
}

export function emptySpec(name) {
  return { format: kFormat, character: { name } };
}

// A point in the world, in the frame of the surroundings that the spec places.
export function toEnvironment(environment, [x, y, z]) {
  const [ox, oy, oz] = environment?.position_m ?? [0, 0, 0];
  const turn = -(environment?.heading_deg ?? 0) * Math.PI / 180;
  const [dx, dz] = [x - ox, z - oz];
  return [dx * Math.cos(turn) + dz * Math.sin(turn), y - oy, dz * Math.cos(turn) - dx * Math.sin(turn)];
}

// "walk on waist, aim on arm_right"
export function actionsText(sequence) {
  const actions = list(sequence?.clips).flatMap((clip) => list(clip.actions));
  return actions.map((action) => `${action.action} on ${action.slot}`).join(', ') || 'nothing';
}

export function lengthOf(clip) {
  if (clip.duration_frames > 0) return clip.duration_frames;
  const ends = list(clip.actions).map((action) => (action.start_frame ?? 0) + (action.duration_frames ?? 30));
  return Math.max(0, ...ends);
}
