// Keeps a limb's bodies apart from others: a limb that would come too near stops on its way, goes on with the joints that
// may, and gets out of the way of what comes towards it.
#pragma once

#include <span>

#include "generator/motion/limb_room.h"
#include "model/motion/motion.h"

namespace contort {

class Clearance {
 public:
  // The character and the room must outlive this object; the room is begun.
  void begin(const Character& character, LimbRoom& room);

  // `shown` holds where the joints of the part's limb are to go from `before`, where they were in the frame before, and
  // then where they go. True if that is elsewhere. `world` holds the transforms of all joints; those of the limb and of
  // what it carries are brought up to date. Joints get out of the way at a third of their greatest speed.
  bool keep(std::size_t part, double frame_s, const Posture& before, Posture& shown, std::span<Rigid> world);

  // The number of times that keep() has changed something since begin().
  int kept() const { return kept_; }

 private:
  struct Case;  // one call

  const Character* character_ = nullptr;
  LimbRoom* room_ = nullptr;
  Posture wanted_;
  int kept_ = 0;
};

}  // namespace contort
