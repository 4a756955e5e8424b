// Lets Contort test the anim component of PlayCanvas. CONTORT_PLAYCANVAS names the folder of the version.
import { limitedJoints } from '../javascript/figure.mjs';
import { serve } from '../javascript/contort_guest.mjs';
import { loadPlayCanvas } from './engine.mjs';
import { actions, LIMITS, operations, Player } from './graph.mjs';

const { pc, version } = await loadPlayCanvas();
const manifest = { name: 'playcanvas', build: version, actions: actions(pc),
  characters: [{ name: 'figure', joints: limitedJoints(LIMITS) }] };

serve(manifest, (request) => {
  const player = new Player(pc, request.uses);
  let next = 0;
  return (timeS, frame) => {
    for (; next < request.uses.length && request.uses[next].start_frame <= frame; ++next) {
      operations[request.uses[next].action].run(player, request.uses[next].params, next);
    }
    player.update(frame === 0 ? 0 : 1 / request.rate_hz);
    return player.row();
  };
});
