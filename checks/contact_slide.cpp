// contact_slide: a joint that the generator declares to stand still must stay within 2 cm of its place. Unlike
// foot_slide, it does not depend on the figure's shape, so figures without colliders are judged too.
#include "checks/check.h"
#include "checks/fixed_limits.h"

namespace contort {

int contact_slide_subject_count(const Character& character) { return static_cast<int>(character.joints().size()); }

Subject contact_slide_subject(const Character& character, int subject) {
  return {character.joints()[static_cast<std::size_t>(subject)].name, "m"};
}

void contact_slide_measure(const CheckInput& in, MarginFold& fold) {
  for (const ContactRun& run : in.foreign->contacts) {
    const std::size_t joint = static_cast<std::size_t>(run.joint);
    const Vec3 place_m = in.world_at(run.first_frame)[joint].p_m;
    for (int frame = run.first_frame; frame <= run.last_frame; ++frame)
      fold.report(run.joint, frame, kSlide_m - length(in.world_at(frame)[joint].p_m - place_m));
  }
}

}  // namespace contort
