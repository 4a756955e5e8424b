#include "cli/case_log.h"

#include "generator/core/json_fields.h"

namespace contort::cli {

Result<CaseLog> CaseLog::open(const std::string& path, bool goes_on) {
  CaseLog log;
  log.path_ = path;
  if (!log.is_kept()) return log;
  log.out_.open(path, goes_on ? std::ios::app : std::ios::trunc);
  if (!log.out_) return Issue{"file.unwritable", "", path + ": cannot be written"};
  return log;
}

std::function<void(const FailingCase&)> CaseLog::listener() {
  if (!is_kept()) return {};
  return [this](const FailingCase& failing) { add(failing); };
}

// To the end at once: whoever follows the file, or kills the run, has whole lines.
void CaseLog::add(const FailingCase& failing) {
  using json_fields::Json;
  const Json line = {{"index", failing.index},
                     {"arm", failing.arm},
                     {"families", failing.families},
                     {"spec", Json::parse(print_spec(failing.spec))}};
  out_ << line.dump() << std::endl;
}

Result<Done> CaseLog::close() {
  out_.close();
  if (is_kept() && !out_) return Issue{"file.unwritable", "", path_ + ": not all failing cases could be written"};
  return Done{};
}

}  // namespace contort::cli
