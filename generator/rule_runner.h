// Runs the rules of actions on single parts, with the memory that rules have between frames.
#pragma once

#include <vector>

#include "generator/motion/limb_room.h"
#include "generator/playback.h"
#include "generator/root_carry.h"
#include "generator/stage.h"

namespace contort {

// One call of an action's rule.
struct RuleCall {
  int action = 0;      // index into Timeline::actions
  int content = 0;     // frame of its sequence
  double came = 0.0;   // the content frame at which it took its part
  int took_over = 0;   // the frame of the motion
  double came_in = 1.0;  // how far it has blended in, [0, 1]
};

// Parts are run carriers first, because rules read the world transforms of the parts that are already placed.
class RuleRunner {
 public:
  void begin(const Stage& stage);
  void start_from(const Posture& posture);  // the posture before frame 0
  void begin_frame();  // clears the feedback of the previous frame

  // The world transforms of a part's own joints in a posture; its carrier must be placed.
  void place(std::size_t part, const Posture& posture);

  // The posture of the part after its rule was applied to the one `beneath` it. `from` is the posture at the action's
  // start, and `carry` the place to which legs have carried the character. Only the part's own entries of the result
  // are valid, until the next run.
  const Posture& run(const Playback& playback, const RuleCall& call, std::size_t part, const Posture& from,
                     const Posture& beneath, const RootCarry& carry);

  const Posture& made() const { return target_; }  // the result of the last run
  LimbRoom& room() { return room_; }
  StandingFeet& feet() { return feet_; }
  WholeBody& body(const PlannedAction& action) { return bodies_[at(action.use)]; }
  const WholeBody& body(const PlannedAction& action) const { return bodies_[at(action.use)]; }
  // The last parameters of an action, computed by its script or given by the spec.
  std::span<const double> last_params(const PlannedAction& action) const {
    return computed_[at(action.use)].empty() ? std::span(action.params) : std::span(computed_[at(action.use)]);
  }
  std::span<const Feedback> feedback() const { return feedback_; }  // by part, of this frame
  std::span<Rigid> world() { return world_; }                       // by joint

 private:
  // The last placement of a part's joints, and its inputs. It is reused, because most parts rest in most frames.
  struct PlacedPart {
    int hangs_on = -1;  // the joint that carries all of them; -1: they are always placed anew
    Rigid carrier;
    std::vector<double> coords;
    std::vector<Rigid> world;
  };

  void move_root(const Rigid& root);
  bool is_as_placed(const PlacedPart& last, const Part& part, const Posture& posture) const;
  void remember(const Part& part, const Posture& posture, std::span<const Rigid> joints, PlacedPart& last);
  std::span<const double> params(const PlannedAction& action, const ActionTime& time, std::size_t part);

  const Stage* stage_ = nullptr;
  StandingFeet feet_;
  LimbRoom room_;
  std::vector<WholeBody> bodies_;  // by use of an action
  std::vector<Feedback> feedback_;
  std::vector<Rigid> world_;
  std::vector<PlacedPart> placed_;  // by part
  std::vector<Rigid> scratch_world_;
  std::vector<double> scratch_row_;
  ScriptHost scripts_;
  std::vector<double> script_row_;
  std::vector<std::vector<double>> computed_;  // parameters, by use; empty if no script computes them
  Posture target_;
};

}  // namespace contort
