// The report: one static page that opens from a file, without server or network, and even without scripts; and the same
// numbers as JSON next to it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "checks/family.h"
#include "corpus/causes.h"
#include "corpus/refusals.h"
#include "corpus/search_progress.h"
#include "model/core/result.h"

namespace contort {

// A bucket of failures. Its texts are untrusted: names come from other people's files.
struct ReportRow {
  std::string family;   // rows of one family share a card
  std::string check;    // "self_collision"
  std::string subject;  // "arm_left/forearm ~ torso/chest"
  std::string unit;     // unit of worst_margin
  double worst_margin = 0.0;
  std::string measured;  // value and limit in the worst frame, "turns 3 600 °/s, limit 733 °/s"; "" if unknown
  std::string sentence;  // the same, or else how far beyond its limit it is, "the figure falls"; "" without a motion
  std::int64_t cases_seen = 0;  // cases of the family, because its buckets can be distinguished only after shrinking
  std::string bucket;           // the bucket's id
  std::string key;              // the name in its files: strips/<key>-*.png, cases/<key>.js
  std::string character;        // name of the character
  bool has_motion = true;       // false: there is nothing for the viewer to play
  std::string printed;          // the last output of a generator that ended; "" if it is no program of its own
  std::string state;            // "new", "open", "regressed", …
  bool gating = false;
  std::string spec_json;       // the minimal spec, laid out for reading
  std::string replay_command;  // the complete command
  std::string strip;           // film strip of the minimal case: a path relative to the page; "" if there is none
  std::string clip;            // animation of its failing half second: the same kind of path
  int first_frame = 0;
  int worst_frame = 0;
  int last_frame = 0;
  int frame_count = 0;  // frames of the minimal motion; 0: unknown
  double rate_hz = 60.0;
  std::string features;   // features of the bucket, which together with the family determine its id
  std::string cause;      // headline of its cause; "" if it has none
  std::string needs;      // the needs of the minimal spec, in words (renders/needs.h)
  std::vector<Family> co_failures;  // other families that its minimal spec shows, too; they have no row of their own
                                    // for that
  std::string case_file;  // file of the minimal case: a relative path, as code hosts require
  std::string since_base;  // result of the base for the same spec (docs/reference/against.md); "" without a comparison
  std::string meaning;    // meaning of the check, in a sentence; may be ""
  std::string note;       // owner, ticket and notes of people: "ana, ticket 12"
  std::string phase;      // phase of the worst frame: "interrupt" (checks/circumstances.h); "" if it is unknown
  std::vector<std::string> actions;  // actions of the minimal spec
  double depth = 0.0;                // depth of the failure, comparable between checks
};

// A cause of failures (docs/reference/causes.md). Its texts are untrusted, too.
struct ReportCause {
  std::string id;
  std::string headline;                 // "Left hand goes through right thigh during aim"
  double severity = 0.0;                // [0, 100]
  std::int64_t cases = 0;               // cases that showed its most frequent family
  std::vector<std::string> characters;  // sorted
  std::vector<std::string> buckets;     // ids, the deepest first
  std::string key;                      // key of the row of its deepest case, if that case has a motion; otherwise ""
  // Sentences about the conditions under which it fails, by character (docs/reference/conditions.md); empty if none
  // were learned.
  std::map<std::string, std::string> conditions{};
  // Without a baseline, a cause is new if nobody has acknowledged any of its failures.
  CauseNews news = CauseNews::known;
};

struct ReportModel {
  std::string title;
  std::string tool;  // "0.1.0"
  std::int64_t cases = 0;
  std::int64_t frames = 0;
  std::int64_t findings = 0;
  std::int64_t families = 0;
  std::int64_t buckets = 0;
  std::string elapsed;  // "12 min"; "" if the page must be the same every time
  std::vector<ReportRow> rows;
  std::vector<ReportCause> causes;  // the most severe first
  bool has_baseline = false;        // true: the news of causes come from a comparison with a baseline
  bool has_engine = false;          // true: the page plays specs with viewer/engine.js (docs/internals/wasm.md)
  SearchProgress search;            // progress of all runs together
  std::vector<std::pair<std::string, std::int64_t>> tested;  // contents of the cases, and how often; 0: never
  std::int64_t unsettled = 0;  // failures of runs that were stopped: neither shrunk nor stored, so they have no row
  std::int64_t refused = 0;  // cases that the generator refused, so that nothing was judged
  RefusalCounts refusals{};  // the generator's reasons
  std::map<std::string, std::int64_t> unmet{};       // cases with a request that was not met (RunRecord::unmet)
  std::map<std::string, std::int64_t> not_judged{};  // cases that a check could not judge (RunRecord::not_judged)
};

// The numbers of rows by kind: failures that are neither fixed nor without a minimal case, and the others.
struct RowCounts {
  std::int64_t failures = 0;
  std::int64_t fixed = 0;
  std::int64_t waiting = 0;      // not shrunk yet, as time was up
  std::int64_t unconfirmed = 0;  // seen once
};
RowCounts row_counts(const ReportModel& model);

// "12 failures of 3 causes; 1 waits to be shrunk".
std::string failures_text(const ReportModel& model);

// "3 failures fail the build, 1 more waits to be shrunk"; "nothing fails the build".
std::string gate_text(const ReportModel& model);

// "15 more failures of a stopped run are not shown: repeat its contort fuzz with --resume."; "" for 0.
std::string unsettled_text(std::int64_t unsettled);

// Returns the sentence of the row; without one the margin, and "" for a failure without a motion.
std::string value_text(const ReportRow& row);

// Returns true if the spec of the row is a minimal one, and not the spec as it was drawn.
bool is_shrunk(const ReportRow& row);

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
