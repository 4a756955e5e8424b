// Keeps a limb's bodies apart from others. A limb that would come too near stops, except for the joints that can
// continue, and it moves away from bodies that come towards it.
#pragma once

#include <span>

#include "generator/motion/joint_path.h"
#include "generator/motion/limb_room.h"
#include "model/motion/motion.h"

namespace contort {

// The postures that were shown in the two frames before this one, and how long a frame lasts.
struct Past {
  Posture before;
  Posture earlier;
  double frame_s = 0.0;
  std::span<const double> easy;  // the greatest accelerations by joint, rad/s^2 or m/s^2; empty without mass
};

// Returns true if a joint moves from the frame before to its place in `shown` slowly enough for a leg whose foot is
// lifted, and without a sudden change of speed.
bool moves_smoothly(const Character& character, int joint, const Past& past, const Posture& shown);

class Clearance {
 public:
  // The character and the room must outlive this object; the room is begun.
  void begin(const Character& character, LimbRoom& room);

  enum class Kept { as_wanted, foot_lifted, elsewhere };

  // The room that the limb would have had at its wanted place, in the last call of keep().
  double wanted_room_m() const { return wanted_m_; }

  struct LimbState {
    bool was_lifted = false;  // its foot, in the frame before
    Haste haste = Haste::at_ease;
    double gap_m = 1.0;  // between bodies of the figure, at most (RoomRange)
  };

  // `shown` has the wanted posture of the part's limb, and then the one that is reached. A foot that stands is lifted.
  // `world` holds the transforms of all joints; those of the limb and of the parts that it carries are updated. Joints
  // give way at a third of their greatest speed. A limb whose foot was lifted in the previous frame returns slowly
  // enough to stop: its knee, which ends straight, is fastest at the end.
  Kept keep(std::size_t part, const Past& past, const LimbState& state, Posture& shown,
            std::span<Rigid> world);

 private:
  struct Case;  // data of one call

  const Character* character_ = nullptr;
  LimbRoom* room_ = nullptr;
  Posture wanted_;
  Posture stay_;  // the posture before, with feet that stand where they were
  Posture saved_;
  Posture spare_;
  double wanted_m_ = 0.0;
};

}  // namespace contort
