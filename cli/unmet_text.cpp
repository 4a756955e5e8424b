#include "cli/unmet_text.h"

#include "checks/withstands.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"
#include "renders/check_words.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

using json_fields::Json;

const std::vector<UnmetRequest>& unmet_of(const Execution& made) {
  static const std::vector<UnmetRequest> none;
  return made.intent ? made.intent->unmet : none;
}

const std::string& slot_of(const Execution& made, const UnmetRequest& unmet) {
  return made.character->parts()[at(unmet.part)].slot;
}

}  // namespace

std::vector<std::string> unmet_lines(const Execution& made) {
  std::vector<std::string> lines;
  for (const UnmetRequest& unmet : unmet_of(made))
    lines.push_back("note: " + unmet.action + " (" + slot_of(made, unmet) + ") was not met in frames " +
                    std::to_string(unmet.first_frame) + "-" + std::to_string(unmet.last_frame) + ": " +
                    std::string(shortfall_text(unmet.why)));
  return lines;
}

std::vector<std::string> overpowered_lines(const Execution& made) {
  const std::optional<Blow> blow = overpowering_blow(*made.character, made.motion);
  if (!blow) return {};
  return {"note: the blow of " + rounded_text(blow->impulse_N_s) + " N s in frame " + std::to_string(blow->frame) +
          " is harder than the " + rounded_text(blow->withstands_N_s) +
          " N s that the figure must withstand: its balance and its return are not judged from then on"};
}

std::string unmet_json(const Execution& made) {
  Json list = Json::array();
  for (const UnmetRequest& unmet : unmet_of(made))
    list.push_back({{"action", unmet.action},
                    {"slot", slot_of(made, unmet)},
                    {"first_frame", unmet.first_frame},
                    {"last_frame", unmet.last_frame},
                    {"why", shortfall_name(unmet.why)}});
  return list.dump();
}

}  // namespace contort::cli
