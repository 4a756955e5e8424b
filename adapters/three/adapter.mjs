// Lets Contort test three.js: the mixer and its actions on a figure that GLTFLoader has read and SkeletonUtils has
// copied, and CCDIKSolver on a crane. CONTORT_THREE names the folder of the version.
import { clips, joints, limitedJoints } from '../javascript/figure.mjs';
import { serve } from '../javascript/contort_guest.mjs';
import { craneAction, craneJoints, startCrane } from './crane.mjs';
import { loadThree } from './engine.mjs';
import { writeGlb } from './glb.mjs';
import { actions, LIMITS, operations, Player } from './mixer.mjs';

const { THREE, version } = await loadThree();
const file = await new Promise((resolve, reject) =>
  new THREE.GLTFLoader().parse(writeGlb(joints, clips), '', resolve, reject));

const manifest = { name: 'three', build: version,
  characters: [{ name: 'figure', joints: limitedJoints(LIMITS) }, { name: 'crane', joints: craneJoints }],
  actions: [...actions(), craneAction] };

function startPlayer(request) {
  const player = new Player(THREE, THREE.SkeletonUtils.clone(file.scene), file.animations, joints);
  let next = 0;
  return (timeS, frame) => {
    for (; next < request.uses.length && request.uses[next].start_frame <= frame; ++next) {
      operations[request.uses[next].action].run(player, request.uses[next].params);
    }
    player.mixer.update(frame === 0 ? 0 : 1 / request.rate_hz);
    return player.row();
  };
}

serve(manifest, (request) => (request.character === 'crane' ? startCrane(THREE, request) : startPlayer(request)));
