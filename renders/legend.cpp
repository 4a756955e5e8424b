#include "renders/legend.h"

#include <algorithm>

#include "renders/contact_marks.h"
#include "renders/range_marks.h"
#include "renders/response_marks.h"
#include "renders/scenery.h"

namespace contort {

namespace {

bool any_instance(std::span<const DrawList> lists, const Vec3& color, bool ghost_only = false) {
  return std::ranges::any_of(lists, [&](const DrawList& list) {
    return std::ranges::any_of(list.instances, [&](const DrawInstance& instance) {
      return instance.color == color && (instance.ghost || !ghost_only);
    });
  });
}

bool any_obstacle(std::span<const DrawList> lists) {
  return std::ranges::any_of(lists, [](const DrawList& list) { return !list.scenery.obstacles.empty(); });
}

}  // namespace

std::string legend_of(const Story& story, std::span<const DrawList> lists) {
  std::string text;
  const auto add = [&](bool occurs, std::string_view words) {
    if (occurs) text += (text.empty() ? "" : "; ") + std::string(words);
  };
  const bool green = any_instance(lists, kBalancedColor) || any_instance(lists, kUnbalancedColor);
  const bool has_range = story.finding != nullptr && story.finding->check == "joint_range";
  add(any_instance(lists, kGhostColor, true), "grey: target motion");
  add(any_instance(lists, kControlColor), "orange arrows: added by dynamics");
  add(any_instance(lists, kImpactColor), "magenta arrow: blow");
  add(any_instance(lists, kLoadColor), "brown box: load");
  add(has_range && any_instance(lists, kAllowedColor), "green: range of the joint, red: beyond it");
  add(!has_range && green, "green or red patch: area under the feet, ball: balance point");
  add(any_instance(lists, kMarkerColor), "yellow dot: joint of the failure");
  add(any_instance(lists, kContactColor), "yellow line: nearest or deepest points");
  add(any_obstacle(lists), "violet: obstacle");
  return text;
}

}  // namespace contort
