#include "renders/check_words.h"

#include <utility>

namespace contort {

std::string check_title(std::string_view check) {
  static constexpr std::pair<std::string_view, std::string_view> kTitles[] = {
      {"non_finite", "NaN, infinite or huge value"},
      {"quaternion_length", "Rotation is not normalised"},
      {"joint_range", "Joint beyond its range"},
      {"off_axis", "Hinge turns about another axis"},
      {"angular_velocity", "Joint too fast"},
      {"pop", "Sudden jump"},
      {"root_pop", "Root jumps"},
      {"angular_acceleration", "Joint changes its speed too abruptly"},
      {"bind_pose_flash", "Flash of the rest pose"},
      {"bone_position", "Point outside its region"},
      {"aim_error", "Aim misses its target"},
      {"reach_error", "Does not reach its target"},
      {"mimic_error", "Does not follow its leading joint"},
      {"residue", "Action leaves an offset behind"},
      {"stuck", "Sequence does not end"},
      {"queue_gap", "Gap between sequences"},
      {"joint_torque", "Joint needs more than its strength"},
      {"balance", "Loses balance"},
      {"tracking_error", "Does not recover from an impact"},
      {"ground_penetration", "Sinks into the ground"},
      {"obstacle_penetration", "Goes through an obstacle"},
      {"foot_slide", "Foot slides"},
      {"self_collision", "Goes through itself"},
      {"contact_slide", "Contact slides"},
      {"rest_error", "Does not come back to rest"},
      {"fresh_error", "Differs after other actions"},
      {"none_error", "Changed by an action without effect"},
      {"history_error", "Depends on earlier requests"},
      {"rate_error", "Depends on the frame rate"},
      {"undo_error", "Does not return after an action"},
      {"gain_error", "Very different for nearly equal parameters"},
      {"mirror_error", "Left and right differ"},
      {"loop_seam", "Loop does not close"},
      {"part_gap", "Joint out of its place"},
      {"unreadable_channel", "Channel that cannot be read"},
      {"translation_pop", "Sudden change of position"},
      {"scale_pop", "Sudden change of size"},
      {"jitter", "Shaking joint"},
      {"crash", "Generator crashed"},
      {"timeout", "Generator did not answer in time"},
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

std::string_view shortfall_text(std::string_view name) {
  for (const Shortfall why : {Shortfall::out_of_reach, Shortfall::joint_range, Shortfall::joint_speed,
                              Shortfall::clearance, Shortfall::rule_failed})
    if (shortfall_name(why) == name) return shortfall_text(why);
  return name;
}

}  // namespace contort
