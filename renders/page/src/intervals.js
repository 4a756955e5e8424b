// The frames in which a check is violated. A finding has only its first and last frame; the curve of the failure says
// which frames between them are.

// Runs of frames with a margin below the limit: [{ first, last }]. A margin that rounding may have made is not counted.
export function violatedRuns(curve) {
  const runs = [];
  curve.margins.forEach((value, frame) => {
    if (value === null || value >= -curve.resolution) return;
    if (runs.length && runs.at(-1).last === frame - 1) runs.at(-1).last = frame;
    else runs.push({ first: frame, last: frame });
  });
  return runs;
}

// Every interval in which the motion violates the failure's check; only the whole of it where no curve tells more.
export function intervalsOf(motion) {
  const runs = motion.curves.length ? violatedRuns(motion.curves[0]) : [];
  if (runs.length || motion.first < 0) return runs;
  return [{ first: motion.first, last: motion.last }];
}
