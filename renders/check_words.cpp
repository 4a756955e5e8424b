#include "renders/check_words.h"

#include <utility>

namespace contort {

std::string check_title(std::string_view check) {
  static constexpr std::pair<std::string_view, std::string_view> kTitles[] = {
      {"non_finite", "Broken numbers"},
      {"quaternion_length", "Rotation is not normalised"},
      {"joint_range", "Joint beyond its range"},
      {"off_axis", "Hinge turns about another axis"},
      {"angular_velocity", "Joint too fast"},
      {"pop", "Sudden jump"},
      {"angular_acceleration", "Joint starts or stops too abruptly"},
      {"bind_pose_flash", "Flash of the rest pose"},
      {"bone_position", "Point outside its region"},
      {"aim_error", "Aims beside its target"},
      {"reach_error", "Does not reach its target"},
      {"residue", "Action leaves something behind"},
      {"stuck", "Sequence does not end"},
      {"queue_gap", "Gap between sequences"},
      {"joint_torque", "Needs more effort than its strength"},
      {"balance", "Loses balance"},
      {"tracking_error", "Does not recover from an impact"},
      {"ground_penetration", "Sinks into the ground"},
      {"obstacle_penetration", "Goes into an obstacle"},
      {"foot_slide", "Foot slides"},
      {"self_collision", "Goes through itself"},
      {"contact_slide", "Contact slides"},
      {"rest_error", "Does not come back to rest"},
      {"fresh_error", "Differs from a fresh start"},
      {"none_error", "Changed by what changes nothing"},
      {"history_error", "Depends on earlier requests"},
      {"rate_error", "Depends on the rate"},
      {"undo_error", "Does not return after an action"},
      {"gain_error", "Jumps between near parameters"},
      {"mirror_error", "Sides differ"},
      {"loop_seam", "Loop does not close"},
      {"part_gap", "Joint out of its place"},
      {"unreadable_channel", "Channel that cannot be read"},
      {"translation_pop", "Sudden change of place"},
      {"scale_pop", "Sudden change of size"},
      {"jitter", "Shaking joint"},
      {"crash", "Generator crashed"},
      {"timeout", "Generator did not end"},
      {"memory", "Generator took too much memory"}};
  for (const auto& [name, title] : kTitles)
    if (name == check) return std::string(title);
  return std::string(check);
}

std::string_view shortfall_text(Shortfall why) {
  switch (why) {
    case Shortfall::out_of_reach: return "it is out of reach";
    case Shortfall::joint_range: return "a joint is at the end of its range";
    case Shortfall::joint_speed: return "there was not enough time for the speed of a joint";
    case Shortfall::clearance: return "bodies would come too near";
    case Shortfall::rule_failed: return "the script of the action stopped";
  }
  return "";
}

}  // namespace contort
