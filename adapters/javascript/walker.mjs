// An arm of two joints that swings. Run it with: contort fuzz --generator "node walker.mjs" --cases 500
import { serve } from './contort_guest.mjs';

const shoulder = { name: 'shoulder', position: [0, 1.4, 0], swing_deg: 130 };
const elbow = { name: 'elbow', parent: 'shoulder', position: [0, -0.3, 0], type: 'hinge', axis: [1, 0, 0],
  low_deg: -150, high_deg: 0 };
const swing = { name: 'swing', help: 'Raises the arm, bends the elbow, and comes back.', duration_s: [0.5, 2],
  params: {
    angle_deg: { type: 'number', low: -90, high: 90, default: 45 },
    bend_deg: { type: 'number', low: 0, high: 110, special: [90] },
  } };
const manifest = { name: 'walker', characters: [{ name: 'hero', joints: [shoulder, elbow] }], actions: [swing] };

serve(manifest, (request) => (timeS) => {
  const pose = request.rest();
  let raisedDeg = 0, bentDeg = 0;
  for (const use of request.uses) {
    const share = Math.sin(Math.PI * request.progress(use, timeS)) ** 2;
    raisedDeg += share * use.params.angle_deg;
    bentDeg += share * use.params.bend_deg;
  }
  pose.turn('shoulder', [1, 0, 0], raisedDeg);
  pose.turn('elbow', [1, 0, 0], -bentDeg);
  return pose;
});
