// Lets Contort test Babylon.js: animation groups on a figure of transform nodes, the same on the bones of a skeleton,
// and the controllers of bones. CONTORT_BABYLON names the folder of the version.
import { limitedJoints } from '../javascript/figure.mjs';
import { serve } from '../javascript/contort_guest.mjs';
import { armActions, armJoints, startArm } from './arm.mjs';
import { clock, loadBabylon } from './engine.mjs';
import { actions, LIMITS, operations, Player } from './groups.mjs';

const { BABYLON, version } = await loadBabylon();
const engine = new BABYLON.NullEngine();
const figure = limitedJoints(LIMITS);
const manifest = { name: 'babylon', build: version,
  characters: [{ name: 'nodes', joints: figure }, { name: 'bones', joints: figure },
    { name: 'arm', joints: armJoints }],
  actions: [...actions(), ...armActions] };

function startPlayer(request) {
  const player = new Player(BABYLON, engine, request.character === 'bones');
  let next = 0;
  player.scene.animate();
  return (timeS, frame) => {
    for (; next < request.uses.length && request.uses[next].start_frame <= frame; ++next) {
      operations[request.uses[next].action].run(player, request.uses[next].params);
    }
    player.advance(frame === 0 ? 0 : 1 / request.rate_hz);
    return player.row();
  };
}

serve(manifest, (request) => {
  engine.scenes.slice().forEach((scene) => scene.dispose());
  clock.ms = 1e6;
  return request.character === 'arm' ? startArm(BABYLON, engine, request) : startPlayer(request);
});
