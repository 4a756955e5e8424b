// Stage to Motion. In each frame the queue says which sequences run; then the parts are moved, from the root outward,
// each by its own stack of layers (base, ik, additive); docs/timeline.md has the rules of both.
#pragma once

#include "generator/stage.h"
#include "model/motion/motion.h"

namespace contort {

// Memory that generate() reuses from call to call; any Stage may follow any other. After the first frame of a motion
// nothing allocates.
struct GenerateScratch {
  SimulationScratch simulation;
  // Who has a layer of a part. An action takes over from the posture that was there: `eased` is how far it had come in
  // the frame before, so that what is left of its way is covered in what is left of its time.
  struct Hold {
    int action = -1;  // index into Timeline::actions; -1: nobody
    int frame = -1;   // in which it took over
    int run = -1;     // index into the queue's history
    double eased = 0.0;
    double came = 0.0;  // when it took over, in frames of its sequence
    int span = -1;         // its entry in Motion::spans
    double since = -1e30;  // start of the latest that had the layer: what started before it does not come back
    int since_action = -1;
  };
  struct Stack {
    Hold overwrite;
    Hold ik;
  };
  PlayQueue queue;
  std::vector<WholeBody> bodies;    // by use of an action
  std::vector<char> signals;        // of the interrupts
  std::vector<Stack> stacks;        // of the parts
  std::vector<Feedback> feedback;   // of the parts, in this frame
  std::vector<int> additive_spans;  // by action: its entry in Motion::spans, or -1
  std::vector<int> aim_spans;       // by action: its entry in Motion::aims, or -1
  std::vector<char> added;          // by part: an additive moved it in this frame
  Posture base;                     // what the overwrite layer has made
  Rigid stands_at;                  // where legs have carried the character: a turn about +Y and a place on the ground
  Posture plain;                    // with ik, without additives: what was seen last, but for these
  Posture from_overwrite;           // where the actions that have the layers took over
  Posture from_ik;
  Posture target;
  Posture shown;
  std::vector<Rigid> world;
};

// Cannot fail: trouble shows in the motion (a NaN is a finding, not an abort). Overwrites `motion`.
void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion);
Motion generate(const Stage& stage);

}  // namespace contort
