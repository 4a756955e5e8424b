#include "fuzz/labels.h"

#include <set>

namespace contort {

namespace {

void add_uses(const Stage& stage, std::vector<std::string>& labels) {
  for (const PlannedAction& action : stage.timeline.actions)
    if (action.part == action.named)
      labels.push_back("action " + action.name + " (" + std::string(layer_name(action.def->layer)) + ") on " +
                       stage.character->parts()[static_cast<std::size_t>(action.part)].slot);
}

// Of actions that move one part at the same time.
std::set<std::string> pairs_of(const Stage& stage) {
  std::set<std::string> pairs;
  const Timeline& timeline = stage.timeline;
  for (std::size_t i = 0; i < timeline.of_part.size(); ++i) {
    const Part& part = stage.character->parts()[i % stage.character->parts().size()];
    for (const int a : timeline.of_part[i])
      for (const int b : timeline.of_part[i]) {
        const PlannedAction& x = timeline.actions[static_cast<std::size_t>(a)];
        const PlannedAction& y = timeline.actions[static_cast<std::size_t>(b)];
        if (a == b || x.name > y.name || x.first_frame > y.last_frame || y.first_frame > x.last_frame) continue;
        pairs.insert("pair " + x.name + " + " + y.name + " on " + part.slot);
      }
  }
  return pairs;
}

void add_scene(const Spec& spec, std::vector<std::string>& labels) {
  labels.push_back("character " + spec.character.name);
  for (const auto& [slot, part] : spec.character.parts) labels.push_back("part " + part);
  for (const AttachmentDesc& attachment : spec.character.attachments) labels.push_back("object " + attachment.object);
  static constexpr const char* kGrounds[] = {"plane", "slope", "steps", "heights"};
  labels.push_back(std::string("ground ") + kGrounds[spec.environment.ground.index()]);
  if (!spec.environment.obstacles.empty()) labels.push_back("obstacle");
  for (const InterruptDesc& interrupt : spec.interrupts)
    labels.push_back("interrupt on " + std::string(event_name(interrupt.when.event)));
}

}  // namespace

std::vector<std::string> labels_of(const Spec& spec, const Stage& stage) {
  std::vector<std::string> labels;
  add_scene(spec, labels);
  add_uses(stage, labels);
  for (const std::string& pair : pairs_of(stage)) labels.push_back(pair);
  return labels;
}

}  // namespace contort
