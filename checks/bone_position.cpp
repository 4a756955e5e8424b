// bone_position: points with a region in the character's file must stay in it, or out of it. Regions move with the
// root, as if the character still stood as it does at rest.
#include <limits>

#include "checks/check.h"
#include "model/geometry/distance.h"

namespace contort {

int bone_position_subject_count(const Character& character) { return static_cast<int>(character.regions().size()); }

Subject bone_position_subject(const Character& character, int subject) {
  return {character.regions()[static_cast<std::size_t>(subject)].name, "m"};
}

void bone_position_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Region> regions = in.character.regions();
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = regions[r];
    const Solid solid = solid_of(region.shape);
    for (int frame = 0; frame < in.motion.frame_count; ++frame) {
      const std::span<const Rigid> world = in.world_at(frame);
      const Rigid character_from_world = in.character.rest_root() * inverse(world[0]);
      Solid point;
      point.center_m = character_from_world * (world[static_cast<std::size_t>(region.joint)] * region.point_m);
      const double distance_m = signed_distance(point, solid, std::numeric_limits<double>::infinity());
      fold.report(static_cast<int>(r), frame, region.keep_out ? distance_m : -distance_m);
    }
  }
}

}  // namespace contort
