// The data that a session's stream has sent of the present take: frames of each mode, margins, spans.
import { list, readCurve, readMark, readSpan, finite, shown } from '../src/case_data.js';
import { bytesOf } from '../src/figure.js';

const kFloatsPerJoint = 7;
const kGap = 120;  // Frames that are asked for before and after one that is missing.

const whole = (value, fallback) => (Number.isInteger(value) ? value : fallback);

function readFinding(finding) {
  return {
    check: shown(finding?.check), subject: shown(finding?.subject), unit: shown(finding?.unit),
    worstMargin: finite(finding?.worst_margin) ? finding.worst_margin : NaN,
    first: whole(finding?.first_frame, 0), worst: whole(finding?.worst_frame, 0), last: whole(finding?.last_frame, 0),
    raw: { check: finding?.check, subject: finding?.subject },
  };
}

export class Tracks {
  constructor() {
    this.begin({});
  }

  begin(take) {
    this.take = whole(take.take, 0);
    this.rate = finite(take.rate_hz) && take.rate_hz > 0 ? take.rate_hz : 60;
    this.frameCount = Math.max(1, whole(take.frame_count, 1));
    this.modes = list(take.modes).filter((mode) => typeof mode === 'string');
    this.model = take.model;
    this.of = new Map(this.modes.map((mode) => [mode,
      { revision: 0, frames: [], curves: [], findings: [], spans: [], marks: [] }]));
  }

  // Returns the mode's track if the data of an event belongs to the present take.
  track(data) {
    return data.take === this.take ? this.of.get(data.mode) : undefined;
  }

  addFrames(data) {
    const track = this.track(data);
    if (!track || !(data.count > 0)) return;
    // The frames of an older revision from here on are void. Frames of one revision may come in any order: those that
    // are waited for first.
    if (data.revision > track.revision) track.frames.length = Math.min(track.frames.length, data.from);
    track.revision = Math.max(track.revision, whole(data.revision, 0));
    this.put(track, data.from, data.count, bytesOf(data.data), true);
  }

  put(track, from, count, bytes, over) {
    const floats = new Float32Array(bytes.buffer, 0, Math.floor(bytes.length / 4));
    const size = floats.length / count;
    if (!Number.isInteger(size) || size % kFloatsPerJoint !== 0) throw new Error('frames of no whole number of joints');
    for (let i = 0; i < count; ++i)
      if (over || !track.frames[from + i]) track.frames[from + i] = floats.subarray(i * size, (i + 1) * size);
  }

  // Frames that were asked for, because the stream begins at the clock. What the stream sent is newer.
  fill(mode, from, buffer) {
    const track = this.of.get(mode);
    const size = track?.frames.findLast((frame) => frame)?.length;
    if (size) this.put(track, from, Math.floor(buffer.byteLength / 4 / size), new Uint8Array(buffer), false);
  }

  // The frames to ask for around this one, if it was never sent: {mode, from, count}; null: none.
  gap(frame) {
    for (const [mode, { frames }] of this.of) {
      if (frames[frame] || frames.length === 0) continue;
      const from = Math.max(0, frame - kGap);
      return { mode, from, count: Math.min(2 * kGap, frames.length - from) };
    }
    return null;
  }

  addMargins(data) {
    const track = this.track(data);
    if (!track) return;
    track.curves = list(data.curves).map(readCurve);
    track.findings = list(data.findings).map(readFinding);
  }

  addSpans(data) {
    const track = this.track(data);
    if (!track) return;
    track.spans = list(data.spans).map((span) => readSpan(span, this.frameCount))
      .filter((span) => span.last >= span.first);
    track.marks = list(data.marks).map(readMark).filter((mark) => mark.frame >= 0 && mark.frame < this.frameCount);
  }

  // The frame's pose, or the one before where that one has not come yet; null where there is none.
  pose(mode, frame) {
    const frames = this.of.get(mode)?.frames ?? [];
    for (let at = Math.min(frame, frames.length - 1); at >= 0; --at) if (frames[at]) return frames[at];
    return null;
  }

  // Last frame that can be shown in every mode; -1: none.
  last() {
    return Math.min(...[...this.of.values()].map((track) => track.frames.length - 1), this.frameCount - 1);
  }
}
