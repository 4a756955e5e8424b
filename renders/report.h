// The report: one static page that opens from a file, without server, network or, if need be, scripts; and the same
// numbers as JSON next to it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "checks/family.h"
#include "corpus/search_progress.h"
#include "model/core/result.h"

namespace contort {

// A bucket of failures. Its texts are untrusted: names come from other people's files.
struct ReportRow {
  std::string family;   // rows of one family share a card
  std::string check;    // "self_collision"
  std::string subject;  // "arm_left/forearm ~ torso/chest"
  std::string unit;     // of worst_margin
  double worst_margin = 0.0;
  std::string measured;  // value and limit in the worst frame, "turns 3 600 °/s, limit 733 °/s"; "" if unknown
  std::int64_t cases_seen = 0;  // of the family: its buckets are told apart only after shrinking
  std::string bucket;           // id
  std::string key;              // names its files: strips/<key>-*.png, cases/<key>.js
  std::string character;        // that moves
  bool has_motion = true;       // false: there is nothing for the viewer to play
  std::string printed;          // the last words of a generator that ended; "" if it is no program of its own
  std::string state;            // "new", "open", "regressed", …
  bool gating = false;
  std::string spec_json;       // the minimal spec, laid out for reading
  std::string replay_command;  // exactly what to type
  std::string strip;           // film strip of the minimal case: a path relative to the page, "" where there is none
  std::string clip;            // the failing half second of it, moving; the same
  int first_frame = 0;
  int worst_frame = 0;
  int last_frame = 0;
  int frame_count = 0;  // of the minimal motion; 0: not known
  double rate_hz = 60.0;
  std::string features;   // of the bucket: what its id is made of beside the family
  std::string cause;      // headline of its cause; "" where it has none
  std::string needs;      // of the minimal spec, in words (renders/needs.h)
  std::vector<Family> co_failures;  // that its minimal spec shows too: they have no row for that
  std::string case_file;  // of the minimal case: a relative path, as code hosts want it
  std::string since_base;  // result of the base for the same spec (docs/reference/against.md); "" without a comparison
  std::string meaning;    // of the check, in a sentence; may be ""
  std::string note;       // the knowledge of people: "ana, ticket 12"
  std::string phase;      // of the worst frame: "interrupt" (checks/circumstances.h); "" where it is not known
  std::vector<std::string> actions;  // of the minimal spec
  double depth = 0.0;                // of the failure, comparable between checks
};

// A cause of failures (docs/reference/causes.md). Its texts are untrusted, too.
struct ReportCause {
  std::string id;
  std::string headline;                 // "Left hand goes through right thigh during aim"
  double severity = 0.0;                // [0, 100]
  std::int64_t cases = 0;               // that showed its most frequent family
  std::vector<std::string> characters;  // sorted
  std::vector<std::string> buckets;     // ids, the deepest first
  std::string key;                      // of the row of its deepest case, if that has a motion; else ""
  // Sentences that say when it fails, by character (docs/reference/conditions.md); empty where none were learned.
  std::map<std::string, std::string> conditions{};
  bool is_new = false;  // not in the baseline; without one, nobody has looked at any of its failures
};

struct ReportModel {
  std::string title;
  std::string tool;  // "0.1.0"
  std::int64_t cases = 0;
  std::int64_t frames = 0;
  std::int64_t findings = 0;
  std::int64_t families = 0;
  std::int64_t buckets = 0;
  std::string elapsed;  // "12 min"; "" where the page has to be the same every time
  std::vector<ReportRow> rows;
  std::vector<ReportCause> causes;  // the most severe first
  bool has_baseline = false;        // by which causes are told to be new
  SearchProgress search;            // of all runs together
  std::vector<std::pair<std::string, std::int64_t>> tested;  // contents of the cases, and how often; 0: never
};

// The files of a page that contains everything, by their paths from it ("viewer/viewer.js", "strips/x.png"), and the
// data of each case and strip, as "cases/<key>.json" and "strips/x.json".
using PageFiles = std::map<std::string, std::string>;

// Returns the page. Equal models give equal pages. Gating families come first; otherwise the order of the rows is
// kept. A page that contains everything has all rows; otherwise rows for which there is no room are left to the other
// files of report_pages.
std::string report_html(const ReportModel& model, const PageFiles& inside = {});
// Returns files by their paths: index.html, below a megabyte, and, if that does not have all rows, more.html (a plain
// list of the others) and rows/part-1.js and so on (the same rows for page.js, which adds them to the page).
PageFiles report_pages(const ReportModel& model);
std::string report_json(const ReportModel& model);

// Writes report_pages() and report.json to `folder`, which is made if it does not exist. Removes further files of an
// earlier, larger report. Codes: file.unwritable; file.outside if one of the folders of a report is a link that leads
// out of it.
Result<Done> write_report(const ReportModel& model, const std::string& folder);

}  // namespace contort
