// Stage to Motion. In each frame the queue determines the running sequences. Then the parts are moved, from the root
// outward, each by its own stack of layers (base, ik, additive). docs/reference/timeline.md has the rules of both.
#pragma once

#include "generator/further_actions.h"
#include "generator/grasps.h"
#include "generator/lags.h"
#include "generator/layer_stack.h"
#include "generator/motion/clearance.h"
#include "generator/motion/joint_path.h"
#include "generator/root_carry.h"
#include "generator/rule_runner.h"
#include "generator/span_recorder.h"
#include "generator/stage.h"
#include "model/motion/motion.h"

namespace contort {

// The whole figure on its layers. Parts are moved one by one, so carriers are already in this frame while the parts
// that they carry are still in the previous one.
struct LayerPostures {
  Posture base;            // the result of the overwrite layer
  Posture stand;           // the base, with feet at rest although a trunk has moved their hips
  Posture plain;           // with ik, without additives
  Posture shown;           // with all layers
  Posture from_overwrite;  // the postures in which the present actions of the layers took over
  Posture from_ik;

  void start_from(const Posture& posture) { base = stand = plain = shown = from_overwrite = from_ik = posture; }
};

// The reason for which a part is not where its layers have it.
enum class Shift : char {
  none,
  planted,   // its foot stays where it stood
  lifted,    // its foot is lifted over the ground
  held_off,  // bodies would have been too near
  over_feet,  // the feet of legs that it carries would not have reached the ground
};

// Memory that generate() reuses from call to call, with any stages. After the first frame of a motion nothing is
// allocated.
struct GenerateScratch {
  SimulationScratch simulation;
  PlayQueue queue;
  LevelPlay level;
  std::vector<char> signals;       // for each interrupt
  std::vector<LayerStack> stacks;  // for each part
  std::vector<char> added;         // by part: true if an additive moved it in this frame
  LayerPostures postures;
  RuleRunner rules;
  JointPath path;                  // path of the shown joints
  std::vector<char> behind;        // by part: true if a joint has not reached its wanted place yet
  Clearance clearance;
  Past past;                       // the earlier frames
  std::vector<char> free_arm;      // by part: true if a gait may swing it
  std::vector<Shift> shift;        // by part
  std::vector<char> settled;       // by part: true once an ik action has left it where it had brought it
  std::vector<char> returns;       // by part: true for a leg or foot that returns to the course that the root follows
  std::vector<char> rests;         // by part: true for a leg or foot that is part of `stand`
  Posture rested;                  // the base of legs and feet when their feet last rested
  std::vector<int> held_off;       // by the last part of a limb: number of frames for which it has been held off
  std::vector<char> stuck;         // likewise: true for a limb that was held off and did not move
  std::vector<char> had_room;      // likewise: true for an idle limb that had room in its posture
  std::vector<char> squeezes;      // likewise: true for a limb that comes back past bodies with a narrow gap
  Posture wanted;                  // wanted posture of a limb that lands
  Posture between;                 // posture between present and wanted
  std::vector<Rigid> rest_world;   // by joint: its place in a leg if only the base moved the leg's carrier
  int legs_taken = -1;             // the frame in which the latest course took the legs over
  int shift_count = 0;             // number of limbs in frames, and of courses that began with a foot elsewhere
  RootCarry carry;
  SpanRecorder spans;
  LagRecorder lags;  // lags of the last motion
  GraspRecorder grasps;
  FurtherActions further;
};

// Cannot fail: faults show in the motion (NaN is a finding, not an abort). Overwrites `motion`.
void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion);
Motion generate(const Stage& stage);

}  // namespace contort
