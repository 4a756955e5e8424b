#include <tinyxml2.h>

#include <algorithm>

#include "renders/ci_outputs.h"
#include "renders/wording.h"

namespace contort {

std::vector<const ReportRow*> gating_first(const ReportModel& model) {
  std::vector<const ReportRow*> rows;
  for (const ReportRow& row : model.rows) rows.push_back(&row);
  std::stable_partition(rows.begin(), rows.end(), [](const ReportRow* row) { return row->gating; });
  return rows;
}

namespace {

using tinyxml2::XMLElement;

// Removes characters that XML cannot contain, even escaped: control characters, and the last two code points of each
// plane.
std::string xml_text(const std::string& text) {
  std::string clean = one_line(text);
  for (const char* none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at = clean.find(none); at != std::string::npos; at = clean.find(none, at))
      clean.replace(at, 3, "\xEF\xBF\xBD");
  return clean;
}

void set(XMLElement* element, const char* name, const std::string& value) {
  element->SetAttribute(name, xml_text(value).c_str());
}

bool was_fixed(const ReportRow& row) { return row.state == "fixed" || row.state == "regressed"; }

void add_case(XMLElement* suite, const ReportRow& row) {
  XMLElement* test = suite->InsertNewChildElement("testcase");
  set(test, "classname", "contort." + row.check);
  set(test, "name", row.bucket + " " + row.subject);
  if (!row.case_file.empty()) set(test, "file", row.case_file);
  if (row.gating) {
    XMLElement* failure = test->InsertNewChildElement("failure");
    const std::string value = value_text(row) + " at frame " + std::to_string(row.worst_frame);
    set(failure, "type", row.check);
    set(failure, "message", row.state + ": " + row.family + ", " + value);
    const std::string since = row.since_base.empty() ? "" : xml_text(row.since_base) + "\n";
    failure->SetText(
        (xml_text(row.family) + "\n" + xml_text(value) + "\n" + since + xml_text(row.replay_command)).c_str());
  } else if (row.state != "fixed") {
    set(test->InsertNewChildElement("skipped"), "message", row.note.empty() ? row.state : row.state + ": " + row.note);
  }
}

struct SuiteCounts {
  int tests = 0, failures = 0, skipped = 0;
};

void set_counts(XMLElement* element, const SuiteCounts& counts) {
  element->SetAttribute("tests", counts.tests);
  element->SetAttribute("failures", counts.failures);
  element->SetAttribute("errors", 0);
  element->SetAttribute("skipped", counts.skipped);
}

SuiteCounts add_suite(XMLElement* suites, const char* name, const ReportModel& model, bool regressions) {
  XMLElement* suite = suites->InsertNewChildElement("testsuite");
  suite->SetAttribute("name", name);
  SuiteCounts counts;
  for (const ReportRow* row : gating_first(model)) {
    if (was_fixed(*row) != regressions) continue;
    add_case(suite, *row);
    ++counts.tests;
    if (row->gating) ++counts.failures;
    if (!row->gating && row->state != "fixed") ++counts.skipped;
  }
  set_counts(suite, counts);
  return counts;
}

}  // namespace

std::string junit_xml(const ReportModel& model) {
  tinyxml2::XMLDocument document;
  document.InsertEndChild(document.NewDeclaration());
  XMLElement* suites = document.NewElement("testsuites");
  document.InsertEndChild(suites);
  set(suites, "name", model.title);
  const SuiteCounts buckets = add_suite(suites, "buckets", model, false);
  const SuiteCounts regressions = add_suite(suites, "regressions", model, true);
  set_counts(suites, {buckets.tests + regressions.tests, buckets.failures + regressions.failures,
                      buckets.skipped + regressions.skipped});
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace contort
