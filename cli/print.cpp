#include "cli/print.h"

#include <cmath>
#include <cstdio>

#include "corpus/lifecycle.h"
#include "corpus/upkeep.h"
#include "model/core/json_fields.h"
#include "renders/wording.h"

namespace contort::cli {

using json_fields::Json;

std::string printable(const std::string& text) {
  std::string out = text;
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return out;
}

std::string known_text(const Bucket& bucket, const std::string& today) {
  std::string text;
  const auto add = [&](const std::string& word) { text += (text.empty() ? "" : ", ") + word; };
  if (!bucket.owner.empty()) add(bucket.owner);
  if (!bucket.ticket.empty()) add(bucket.ticket);
  if (bucket.state == BucketState::quarantined)
    add((is_expired(bucket, today) ? "EXPIRED " : "until ") + bucket.expires + ": " + bucket.reason);
  if (is_stale(bucket)) add("STALE, it passes");
  return text;
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value < 0 ? "-inf" : "inf";
  return rounded_text(value);
}

std::string decimal(double value, int digits) {
  if (!(std::fabs(value) < 1e9)) return short_number(value);
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string finding_line(const Finding& finding, const std::string& value, double rate_hz,
                         const Circumstances& at_worst) {
  char frames[120];
  std::snprintf(frames, sizeof frames, "frames %d-%d, worst %d (%s s)", finding.first_frame, finding.last_frame,
                finding.worst_frame, decimal(finding.worst_frame / rate_hz, 3).c_str());
  std::string line = finding.check + "  " + finding.subject + "  " + value + "  " + frames + "  " + std::string(phase_name(at_worst.phase));
  for (const ActiveAction& action : at_worst.actions)
    line += (&action == at_worst.actions.data() ? ": " : ", ") + action.name + " (" + action.slot + ")";
  return line;
}

std::string findings_json(const std::vector<Finding>& findings, double rate_hz,
                          const std::vector<Circumstances>& at_worst) {
  Json list = Json::array();
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Finding& finding = findings[i];
    Json actions = Json::array();
    for (const ActiveAction& action : at_worst[i].actions)
      actions.push_back({{"action", action.name}, {"slot", action.slot}, {"pointer", action.pointer}});
    const bool finite = std::isfinite(finding.worst_margin);
    list.push_back({{"check", finding.check},
                    {"subject", finding.subject},
                    {"unit", finding.unit},
                    {"worst_margin", finite ? Json(finding.worst_margin) : Json()},
                    {"depth", finite ? Json(finding.depth) : Json()},
                    {"first_frame", finding.first_frame},
                    {"worst_frame", finding.worst_frame},
                    {"last_frame", finding.last_frame},
                    {"worst_time_s", finding.worst_frame / rate_hz},
                    {"phase", phase_name(at_worst[i].phase)},
                    {"actions", actions}});
  }
  return list.dump(2);
}

namespace {

std::string waiver_state(const WaiverUse& use) {
  if (use.expired) return "expired";
  return use.hidden == 0 ? "useless" : "used";
}

}  // namespace

void warn_of_other_rules(const Corpus& corpus) {
  if (const int count = named_by_other_rules(corpus); count > 0)
    std::fprintf(stderr,
                 "contort: %d buckets are named by the rules of another version, so what comes back of them counts as "
                 "new: contort corpus rekey %s\n",
                 count, printable(corpus.folder()).c_str());
}

std::vector<std::string> waiver_lines(const CheckSettings& settings, const std::vector<WaiverUse>& uses) {
  std::vector<std::string> lines;
  for (std::size_t w = 0; w < uses.size(); ++w) {
    const Waiver& waiver = settings.waivers[w];
    const std::string who = "waiver " + std::to_string(w) + " (" + waiver.check + " " + waiver.subject + ", " +
                            waiver.owner + ", until " + waiver.expires + ")";
    const std::string count = std::to_string(uses[w].hidden);
    const std::string state = waiver_state(uses[w]);
    lines.push_back(state == "expired"   ? "EXPIRED: " + who + " hides nothing any more; it would have hidden " + count
                    : state == "useless" ? "USELESS: " + who + " hid nothing here; remove it if it never does"
                                         : "waived: " + count + " by " + who + ": " + waiver.reason);
  }
  return lines;
}

std::string waivers_json(const CheckSettings& settings, const std::vector<WaiverUse>& uses) {
  Json list = Json::array();
  for (std::size_t w = 0; w < uses.size(); ++w) {
    const Waiver& waiver = settings.waivers[w];
    list.push_back({{"pointer", "/waivers/" + std::to_string(w)},
                    {"check", waiver.check},
                    {"subject", waiver.subject},
                    {"owner", waiver.owner},
                    {"expires", waiver.expires},
                    {"reason", waiver.reason},
                    {"state", waiver_state(uses[w])},
                    {"findings", uses[w].hidden}});
  }
  return list.dump();
}

}  // namespace contort::cli
