#include "fuzz/labels.h"

#include <algorithm>
#include <map>

#include "checks/circumstances.h"

namespace contort {

namespace {

std::string use_label(const OfferedAction& action, const std::string& slot) {
  return "action " + action.name + " (" + std::string(layer_name(action.layer)) + ") on " + slot;
}

std::string pair_label(const std::string& one, const std::string& other, const std::string& slot) {
  return "pair " + std::min(one, other) + " + " + std::max(one, other) + " on " + slot;
}

// The phases in which an action moved the part that it names, one bit for each.
unsigned phases_in(const IntendedAction& action, const Motion& motion, const std::vector<Phase>& of_frames) {
  unsigned phases = 0;
  for (const ActionSpan& span : motion.spans)
    for (int f = span.first_frame; is_of(span, action) && f <= span.last_frame; ++f)
      phases |= 1U << static_cast<unsigned>(of_frames[static_cast<std::size_t>(f)]);
  return phases;
}

// Visits each use of an action in the spec.
template <class Visit>
void for_uses(const Spec& spec, Visit visit) {
  const auto each = [&](const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips)
      for (const ActionUse& use : clip.actions) visit(use);
  };
  for (const SequenceDesc& sequence : spec.sequences) each(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) each(interrupt.sequence);
}

void add_uses(const Spec& spec, const Offers& offers, const Character& character, std::vector<std::string>& labels) {
  for_uses(spec, [&](const ActionUse& use) {
    const OfferedAction* action = find_offer(offers, character.find_part(use.slot), use.action);
    if (action != nullptr) labels.push_back(use_label(*action, use.slot));
  });
}

void add_phases(const Intent& intent, const Offers& offers, const Execution& execution,
                std::vector<std::string>& labels) {
  const std::vector<Phase> of_frames = phases_of(intent, execution.motion);
  for (const IntendedAction& action : intent.actions) {
    if (action.part != action.named) continue;
    const OfferedAction* offered = find_offer(offers, action.named, action.name);
    if (offered == nullptr) continue;
    const std::string& slot = execution.character->parts()[static_cast<std::size_t>(action.part)].slot;
    const unsigned phases = phases_in(action, execution.motion, of_frames);
    for (std::size_t p = 0; p < phase_names().size(); ++p)
      if ((phases >> p & 1U) != 0)
        labels.push_back(use_label(*offered, slot) + " in " + std::string(phase_names()[p]));
  }
}

// Returns true if the actions share more than the frame in which one ends and the other begins.
bool overlap(const IntendedAction& x, const IntendedAction& y) {
  return x.sequence == y.sequence && x.part == y.part && x.first_frame < y.last_frame && y.first_frame < x.last_frame;
}

// Labels of pairs of actions that the spec lets move one part at the same time.
std::set<std::string> pairs_of(const Intent& intent, const Character& character) {
  std::set<std::string> pairs;
  for (auto x = intent.actions.begin(); x != intent.actions.end(); ++x)
    for (auto y = x + 1; y != intent.actions.end(); ++y)
      if (!x->further && !y->further && overlap(*x, *y))
        pairs.insert(pair_label(x->name, y->name, character.parts()[static_cast<std::size_t>(x->part)].slot));
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

std::vector<std::string> labels_of(const Spec& spec, Generator& generator, const Execution& execution) {
  const Offers& offers = generator.offers(*execution.character);
  std::vector<std::string> labels;
  add_scene(spec, labels);
  add_uses(spec, offers, *execution.character, labels);
  if (!execution.intent) return labels;
  add_phases(*execution.intent, offers, execution, labels);
  for (const std::string& pair : pairs_of(*execution.intent, *execution.character)) labels.push_back(pair);
  return labels;
}

// Pairs of a slot: all actions of its parts, also with themselves, and actions of other slots that move it.
std::set<std::string> possible_labels(Generator& generator, const Character& character) {
  const Offers& offers = generator.offers(character);
  const auto slot_of = [&](std::size_t part) -> const std::string& { return character.parts()[part].slot; };
  std::set<std::string> labels;
  std::map<std::string, std::set<std::string>> movers;  // names of actions, by the slot that they move
  for (std::size_t p = 0; p < offers.size(); ++p)
    for (const OfferedAction& action : offers[p]) {
      labels.insert(use_label(action, slot_of(p)));
      for (const int moved : action.moves) movers[slot_of(static_cast<std::size_t>(moved))].insert(action.name);
    }
  for (const auto& [slot, names] : movers)
    for (auto a = names.begin(); a != names.end(); ++a)
      for (auto b = a; b != names.end(); ++b) labels.insert(pair_label(*a, *b, slot));
  return labels;
}

std::vector<std::string> unmet_labels(const Execution& execution) {
  std::set<std::string> labels;
  if (!execution.intent) return {};
  for (const UnmetRequest& unmet : execution.intent->unmet)
    labels.insert(unmet.action + " on " + execution.character->parts()[static_cast<std::size_t>(unmet.part)].slot + ": " +
                  std::string(shortfall_name(unmet.why)));
  return {labels.begin(), labels.end()};
}

std::vector<std::string> not_judged_labels(const std::vector<NotJudged>& not_judged) {
  std::vector<std::string> labels;
  for (const NotJudged& one : not_judged) labels.push_back(std::string(one.check) + ": " + std::string(one.reason));
  return labels;
}

}  // namespace contort
