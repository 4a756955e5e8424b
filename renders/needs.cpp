#include "renders/needs.h"

#include <cstdio>
#include <set>

#include "renders/wording.h"

namespace contort {
namespace {

constexpr std::size_t kMostParts = 2;  // greatest number of parts that are named

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string actions_of(const Spec& spec) {
  const std::vector<std::string> names = action_names(spec);
  const std::set<std::string> actions(names.begin(), names.end());
  if (!spec.recording.name.empty()) return "the recording " + one_line(spec.recording.name);
  return actions.empty() ? "no action" : joined({actions.begin(), actions.end()}, " + ");
}

std::size_t count_clips(const Spec& spec) {
  std::size_t count = 0;
  for (const SequenceDesc& sequence : spec.sequences) count += sequence.clips.size();
  return count;
}

// Adds "an interrupt" or "2 interrupts".
void add_some(std::vector<std::string>& needs, std::size_t count, const char* one, const char* many) {
  if (count == 1) needs.emplace_back(one);
  if (count > 1) needs.push_back(std::to_string(count) + " " + many);
}

void add_several(std::vector<std::string>& needs, std::size_t count, const char* many) {
  if (count > 1) needs.push_back(std::to_string(count) + " " + many);
}

void add_figure(std::vector<std::string>& needs, const CharacterChoice& character) {
  if (character.parts.size() > kMostParts) {
    needs.push_back(std::to_string(character.parts.size()) + " swapped parts");
  } else {
    for (const auto& [slot, part] : character.parts) needs.push_back(one_line(part) + " as " + one_line(slot));
  }
  for (const AttachmentDesc& attached : character.attachments) needs.push_back(one_line(attached.object));
}

void add_surroundings(std::vector<std::string>& needs, const EnvironmentDesc& environment) {
  static constexpr const char* kGrounds[] = {"", "a slope", "steps", "uneven ground"};  // by variant of the ground
  if (const char* ground = kGrounds[environment.ground.index()]; *ground != '\0') needs.emplace_back(ground);
  add_some(needs, environment.obstacles.size(), "an obstacle", "obstacles");
}

std::string rate_text(double rate_hz) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g frames a second", rate_hz);
  return text;
}

}  // namespace

std::vector<std::string> action_names(const Spec& spec) {
  std::vector<std::string> names;
  const auto add = [&](const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips)
      for (const ActionUse& use : clip.actions) names.push_back(use.action);
  };
  for (const SequenceDesc& sequence : spec.sequences) add(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) add(interrupt.sequence);
  return names;
}

std::string needs_of(const Spec& spec) {
  std::vector<std::string> needs = {actions_of(spec)};
  add_several(needs, count_clips(spec), "clips");
  add_several(needs, spec.sequences.size(), "sequences");
  add_some(needs, spec.interrupts.size(), "an interrupt", "interrupts");
  add_figure(needs, spec.character);
  if (spec.dynamics.mode != Mode::kinematic)
    needs.push_back("mode " + std::string(mode_names()[static_cast<std::size_t>(spec.dynamics.mode)]));
  add_some(needs, spec.dynamics.impacts.size(), "a blow", "blows");
  add_some(needs, spec.dynamics.loads.size(), "a load", "loads");
  add_surroundings(needs, spec.environment);
  if (spec.rate_hz != Spec{}.rate_hz) needs.push_back(rate_text(spec.rate_hz));
  return joined(needs, ", ");
}

}  // namespace contort
