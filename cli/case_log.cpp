#include "cli/case_log.h"

#include "model/core/json_fields.h"

namespace contort::cli {

Result<CaseLog> CaseLog::open(const std::string& path, bool goes_on) {
  CaseLog log;
  log.path_ = path;
  if (!log.is_kept()) return log;
  Result<OutputFile> opened = open_output(path, goes_on ? Start::at_the_end : Start::anew);
  if (!opened) return opened.issue();
  log.out_ = std::move(opened).value();
  return log;
}

std::function<void(const FailingCase&)> CaseLog::listener() {
  if (!is_kept()) return {};
  return [this](const FailingCase& failing) { add(failing); };
}

// Flushes each line, so that readers see whole lines even if the run is killed.
void CaseLog::add(const FailingCase& failing) {
  using json_fields::Json;
  Json families = Json::array();
  for (const Family& family : failing.families) families.push_back(print_family(family));
  const Json line = {{"index", failing.index},
                     {"arm", failing.arm},
                     {"families", families},
                     {"spec", Json::parse(print_spec(failing.spec))}};
  const std::string text = line.dump() + "\n";
  lost_ |= std::fwrite(text.data(), 1, text.size(), out_.get()) != text.size() || std::fflush(out_.get()) != 0;
}

Result<Done> CaseLog::close() {
  if (!is_kept()) return Done{};
  lost_ |= std::fclose(out_.release()) != 0;
  if (lost_) return Issue{"file.unwritable", "", path_ + ": not all failing cases could be written"};
  return Done{};
}

}  // namespace contort::cli
