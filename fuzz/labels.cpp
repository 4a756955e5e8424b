#include "fuzz/labels.h"

#include <algorithm>
#include <map>

#include "checks/circumstances.h"
#include "generator/actions/action.h"
#include "generator/intent.h"

namespace contort {

namespace {

std::string use_label(const std::string& name, const ActionDef& def, const Part& part) {
  return "action " + name + " (" + std::string(layer_name(def.layer)) + ") on " + part.slot;
}

std::string pair_label(const std::string& one, const std::string& other, const std::string& slot) {
  return "pair " + std::min(one, other) + " + " + std::max(one, other) + " on " + slot;
}

// In which phases an action moved its part: a bit for each.
unsigned phases_in(const PlannedAction& action, const Motion& motion, const std::vector<Phase>& of_frames) {
  unsigned phases = 0;
  for (const ActionSpan& span : motion.spans)
    for (int f = span.first_frame; is_of(span, action) && f <= span.last_frame; ++f)
      phases |= 1U << static_cast<unsigned>(of_frames[static_cast<std::size_t>(f)]);
  return phases;
}

void add_uses(const Stage& stage, const Motion& motion, std::vector<std::string>& labels) {
  const std::vector<Phase> of_frames = phases_of(intent_of(stage, motion), motion);
  for (const PlannedAction& action : stage.timeline.actions) {
    if (action.part != action.named) continue;
    const Part& part = stage.character->parts()[static_cast<std::size_t>(action.part)];
    const std::string label = use_label(action.name, *action.def, part);
    labels.push_back(label);
    const unsigned phases = phases_in(action, motion, of_frames);
    for (std::size_t p = 0; p < phase_names().size(); ++p)
      if ((phases >> p & 1U) != 0) labels.push_back(label + " in " + std::string(phase_names()[p]));
  }
}

// More than the frame in which the one ends and the other begins.
bool overlap(const PlannedAction& x, const PlannedAction& y) {
  return x.first_frame < y.last_frame && y.first_frame < x.last_frame;
}

// Of actions that are planned for one part at the same time.
std::set<std::string> pairs_of(const Stage& stage) {
  std::set<std::string> pairs;
  const Timeline& timeline = stage.timeline;
  for (std::size_t i = 0; i < timeline.of_part.size(); ++i) {
    const Part& part = stage.character->parts()[i % stage.character->parts().size()];
    for (const int a : timeline.of_part[i])
      for (const int b : timeline.of_part[i]) {
        const PlannedAction& x = timeline.actions[static_cast<std::size_t>(a)];
        const PlannedAction& y = timeline.actions[static_cast<std::size_t>(b)];
        if (a < b && overlap(x, y)) pairs.insert(pair_label(x.name, y.name, part.slot));
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

std::vector<std::string> labels_of(const Spec& spec, const Stage& stage, const Motion& motion) {
  std::vector<std::string> labels;
  add_scene(spec, labels);
  add_uses(stage, motion, labels);
  for (const std::string& pair : pairs_of(stage)) labels.push_back(pair);
  return labels;
}

// A slot's pairs are of what its parts can do, an action with itself too, and of what moves them from elsewhere.
std::set<std::string> possible_labels(const Character& character) {
  std::set<std::string> labels;
  std::map<std::string, std::set<std::string>> movers;  // actions, by the slot that they move
  for (std::size_t p = 0; p < character.parts().size(); ++p) {
    const Part& part = character.parts()[p];
    for (const Action& action : actions_of(character, part)) {
      labels.insert(use_label(std::string(action.name), *action.def, part));
      for (const int moved : parts_moved(*action.def, character, static_cast<int>(p)))
        movers[character.parts()[static_cast<std::size_t>(moved)].slot].emplace(action.name);
    }
  }
  for (const auto& [slot, names] : movers)
    for (auto a = names.begin(); a != names.end(); ++a)
      for (auto b = a; b != names.end(); ++b) labels.insert(pair_label(*a, *b, slot));
  return labels;
}

}  // namespace contort
