#include "fuzz/messages.h"

#include <algorithm>
#include <stdexcept>

#include "fuzz/message_fields.h"

namespace contort {

namespace {

template <class T>
T parsed(const std::string& text) {
  Result<T> value = json_fields::read_document<T>(text, "message");
  if (!value) throw std::logic_error(to_line(value.issue()));
  return std::move(value).value();
}

}  // namespace

std::vector<Family> counted_families(const EvaluateReport& report) {
  if (!report.against) return report.broken;
  const Comparison& against = *report.against;
  std::vector<Family> counted;
  for (const Family& family : report.broken)
    if (std::ranges::binary_search(against.broke, family) || std::ranges::binary_search(against.worse, family))
      counted.push_back(family);
  return counted;
}

std::string print_task(const Task& task) { return json_fields::write_canonical(task); }
Task parse_task(const std::string& text) { return parsed<Task>(text); }

template <class Report>
std::string print_report(const Report& report) {
  return json_fields::write_canonical(report);
}

template <class Report>
Report parse_report(const std::string& text) {
  return parsed<Report>(text);
}

template std::string print_report(const EvaluateReport&);
template std::string print_report(const SettleReport&);
template std::string print_report(const ShrinkReport&);
template EvaluateReport parse_report(const std::string&);
template SettleReport parse_report(const std::string&);
template ShrinkReport parse_report(const std::string&);

}  // namespace contort
