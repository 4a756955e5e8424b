// Stage to Motion. In each frame the queue says which sequences run; then the parts are moved, from the root outward,
// each by its own stack of layers (base, ik, additive); docs/reference/timeline.md has the rules of both.
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

// The whole figure on its layers. Parts are moved one by one, so carriers are in this frame while what they carry still
// is in the frame before.
struct LayerPostures {
  Posture base;            // the result of the overwrite layer
  Posture stand;           // the base, with feet where they rest although a trunk has moved their hips
  Posture plain;           // with ik, without additives
  Posture shown;           // with all layers
  Posture from_overwrite;  // where the actions that have the layers took over
  Posture from_ik;

  void start_from(const Posture& posture) { base = stand = plain = shown = from_overwrite = from_ik = posture; }
};

// The reason for which a part is elsewhere than its layers have it.
enum class Shift : char {
  none,
  planted,   // its foot stays where it stood
  lifted,    // its foot is lifted over the ground
  held_off,  // bodies would have come too near
  over_feet,  // feet that stand on legs that it carries would not have reached the ground
};

// Memory that generate() reuses from call to call; any Stage may follow any other. After the first frame of a motion
// nothing allocates.
struct GenerateScratch {
  SimulationScratch simulation;
  PlayQueue queue;
  LevelPlay level;
  std::vector<char> signals;       // of the interrupts
  std::vector<LayerStack> stacks;  // of the parts
  std::vector<char> added;         // by part: an additive moved it in this frame
  LayerPostures postures;
  RuleRunner rules;
  JointPath path;                  // of the joints that are shown
  std::vector<char> behind;        // by part: a joint is still on its way to where it is wanted
  Clearance clearance;
  Past past;                       // the earlier frames
  std::vector<char> free_arm;      // by part: a gait may swing it
  std::vector<Shift> shift;        // by part
  std::vector<char> returns;       // by part: a leg or foot on its way back to the course that the root follows
  std::vector<char> rests;         // by part: a leg or foot that `stand` has
  Posture rested;                  // the base of legs and feet while their feet rested last
  std::vector<int> held_off;       // by the last part of a limb: for how many frames it has been
  Posture wanted;                  // of a limb that lands
  Posture between;                 // on its way
  std::vector<Rigid> rest_world;   // by joint: where its leg would be if nothing but the base moved what carries it
  int legs_taken = -1;             // the frame in which the latest course took the legs over
  int shift_count = 0;             // of limbs in frames, and of courses that began with a foot elsewhere
  RootCarry carry;
  SpanRecorder spans;
  LagRecorder lags;  // of the last motion
  GraspRecorder grasps;
  FurtherActions further;
};

// Cannot fail: trouble shows in the motion (a NaN is a finding, not an abort). Overwrites `motion`.
void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion);
Motion generate(const Stage& stage);

}  // namespace contort
