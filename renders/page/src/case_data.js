// Checks the data of a case and fills what is left out, so that the rest of the viewer can trust it.
// A case that cannot be shown throws a Damaged with a sentence for the reader.

export class Damaged extends Error {}

const kFormat = 'contort.report_case/1';

export const list = (value) => (Array.isArray(value) ? value : []);
export const text = (value) => (typeof value === 'string' ? value : '');
// For texts that are only shown: signs that turn the order of a text around, or control signs, become visible.
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u200e\u200f\u2028-\u202e\u2066-\u2069]/g;
export const shown = (value) => text(value).replace(kUnseen, '\ufffd');
const whole = (value, fallback) => (Number.isInteger(value) ? value : fallback);
export const finite = (value) => typeof value === 'number' && Number.isFinite(value);
const point = (value) => Array.isArray(value) && value.length === 3 && value.every(finite);

export function readCurve(curve) {
  return {
    check: shown(curve?.check),
    subject: shown(curve?.subject),
    unit: shown(curve?.unit),
    scale: finite(curve?.scale) && curve.scale > 0 ? curve.scale : 1,
    resolution: finite(curve?.resolution) && curve.resolution > 0 ? curve.resolution : 0,
    margins: list(curve?.margins).map((margin) => (finite(margin) ? margin : null)),
  };
}

export function readSpan(span, frameCount) {
  const first = Math.max(0, whole(span?.first_frame, 0));
  return {
    name: shown(span?.name), slot: shown(span?.slot), clip: shown(span?.clip), action: shown(span?.action),
    sequence: shown(span?.sequence) || (Number.isInteger(span?.sequence) ? String(span.sequence) : ''),
    first, last: Math.min(frameCount - 1, whole(span?.last_frame, frameCount - 1)),
  };
}

export function readMark(mark) {
  return {
    frame: whole(mark?.frame, -1), kind: shown(mark?.kind), text: shown(mark?.text),
    point: point(mark?.point) ? mark.point : null, impulse: point(mark?.impulse) ? mark.impulse : null,
  };
}

function readBalance(entry) {
  return entry && point(entry.zmp) ? { zmp: entry.zmp, margin: finite(entry.margin) ? entry.margin : null } : null;
}

// A request that was not met, and a check that could not judge: sentences for the reader.
const readUnmet = (entry) => ({
  action: shown(entry?.action), slot: shown(entry?.slot), why: shown(entry?.why),
  first: whole(entry?.first_frame, -1), last: whole(entry?.last_frame, -1),
});
const readNotJudged = (entry) =>
  ({ check: shown(entry?.check), title: shown(entry?.title), reason: shown(entry?.reason) });

export function readGround(ground) {
  if (Array.isArray(ground?.positions) && ground.positions.every(finite) && ground.positions.length >= 9)
    return { positions: ground.positions, indices: list(ground.indices).filter(Number.isInteger) };
  return { level: finite(ground?.level) ? ground.level : 0 };
}

function readMotion(motion) {
  const frameCount = whole(motion?.frame_count, 0);
  if (frameCount < 1) throw new Damaged('a motion has no frames');
  if (!(finite(motion.rate_hz) && motion.rate_hz > 0)) throw new Damaged('a motion has no frame rate');
  return {
    role: text(motion.role), rate: motion.rate_hz, frameCount,
    first: whole(motion.first_frame, -1), worst: Math.min(whole(motion.worst_frame, -1), frameCount - 1),
    last: whole(motion.last_frame, -1),
    spec: motion.spec ?? null,
    freeFields: new Set(list(motion.free_fields).filter((field) => typeof field === 'string')),
    glb: text(motion.glb), ghostGlb: text(motion.ghost_glb),
    colliders: list(motion.colliders).filter((shape) => shape && typeof shape === 'object'),
    highlight: {
      joints: list(motion.highlight?.joints).map(text),
      colliders: list(motion.highlight?.colliders).map((solid) => list(solid).map(text)),
    },
    ground: readGround(motion.ground),
    obstacles: list(motion.obstacles).filter((shape) => shape && typeof shape === 'object'),
    spans: list(motion.spans).map((span) => readSpan(span, frameCount)).filter((span) => span.last >= span.first),
    marks: list(motion.marks).map(readMark).filter((mark) => mark.frame >= 0 && mark.frame < frameCount),
    balance: list(motion.balance).map(readBalance),
    measured: shown(motion.measured),
    unmet: list(motion.unmet).map(readUnmet), notJudged: list(motion.not_judged).map(readNotJudged),
    curves: list(motion.curves).map(readCurve),
  };
}

export function readCase(data) {
  if (!data || typeof data !== 'object') throw new Damaged('it holds no case');
  if (data.format !== kFormat) throw new Damaged(`its format is not ${kFormat}`);
  if (text(data.problem)) throw new Damaged(shown(data.problem));
  const motions = list(data.motions).map(readMotion);
  if (motions.length === 0) throw new Damaged('it holds no motion');
  return {
    key: text(data.key), check: shown(data.check), subject: shown(data.subject), unit: shown(data.unit),
    title: shown(data.title), character: shown(data.character),
    meaning: shown(data.meaning), phase: shown(data.phase), needs: shown(data.needs),
    worstMargin: finite(data.worst_margin) ? data.worst_margin : NaN, motions,
  };
}
