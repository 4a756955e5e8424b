#include "corpus/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "model/core/hash.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;
using MarginsByName = std::map<std::pair<std::string, std::string>, SubjectMargin>;

double finite_or_nan(double margin) {
  return std::isfinite(margin) ? margin : std::numeric_limits<double>::quiet_NaN();
}

void keep_deepest(const Finding& finding, bool waived, MarginsByName& deepest) {
  const SubjectMargin found{finding.check, finding.subject, finite_or_nan(-finding.depth), waived};
  const auto [known, is_first] = deepest.try_emplace({finding.check, finding.subject}, found);
  if (is_first || known->second.waived != waived) return;
  if (std::isnan(found.margin) || found.margin < known->second.margin) known->second = found;
}

// Failures that are not waived come first, because a run reports these.
MarginsByName deepest_findings(const Evaluation& evaluation) {
  MarginsByName deepest;
  for (const Finding& finding : evaluation.findings) keep_deepest(finding, false, deepest);
  for (const WaivedFinding& waived : evaluation.waived) keep_deepest(waived.finding, true, deepest);
  return deepest;
}

// The margin of a subject that passes may be below 0 by rounding, or because frames after a loss of balance are not
// judged. Then it counts as 0.
MarginsByName margins_without(const MarginsByName& findings, const Evaluator& evaluator) {
  MarginsByName passing;
  for (const SmallestMargins& row : evaluator.smallest_margins())
    for (std::size_t s = 0; s < row.of_subject.size(); ++s) {
      const double margin = row.of_subject[s] / row.check->scale;
      if (!std::isfinite(margin)) continue;
      const Subject subject = row.check->subject(*evaluator.execution().character, static_cast<int>(s));
      const std::pair name{std::string(row.check->name), subject.name};
      if (!findings.contains(name)) passing[name] = {name.first, name.second, std::max(0.0, margin)};
    }
  return passing;
}

std::vector<SubjectMargin> as_list(MarginsByName margins) {
  std::vector<SubjectMargin> list;
  for (auto& [name, margin] : margins) list.push_back(std::move(margin));
  return list;
}

const json_fields::Rule kWholeId{.low = -1, .high = 0x1p53};
const json_fields::Rule kManySubjects{.max_count = 100'000};
const json_fields::Rule kAnyProse{.text = json_fields::Text::prose, .may_be_empty = true};

}  // namespace

template <class V>
void fields(V& v, const SubjectMargin*) {
  v.field("check", &SubjectMargin::check, {.required = true}, "The check.");
  v.field("subject", &SubjectMargin::subject, {.text = json_fields::Text::prose, .required = true},
          "Joint, part or pair of bodies that the check judges.");
  v.field("margin", &SubjectMargin::margin, {.required = true, .may_be_nan = true}, "Margin in the check's scale.");
  v.field("waived", &SubjectMargin::waived, {}, "Whether a waiver hides the finding.");
}

template <class V>
void fields(V& v, const Issue*) {
  v.field("code", &Issue::code, kAnyProse, "Stable name.");
  v.field("pointer", &Issue::pointer, kAnyProse, "Place in the request.");
  v.field("text", &Issue::text, kAnyProse, "Sentence for people.");
}

template <class V>
void fields(V& v, const Measurement*) {
  v.field("id", &Measurement::id, kWholeId, "Of the request.");
  v.field("motion_hash", &Measurement::motion_hash, {.text = json_fields::Text::hex, .digits = 16}, "Of all frames.");
  v.field("frames", &Measurement::frames, {.low = 0}, "Of the motion.");
  v.field("trace", &Measurement::trace, {.text = json_fields::Text::hex}, "Running hash of the motion.");
  v.field("findings", &Measurement::findings, kManySubjects, "Deepest failure of each family.");
  v.field("margins", &Measurement::margins, kManySubjects, "Of subjects that pass.");
  v.field("error", &Measurement::refusal, {}, "Why there is no measurement.");
}

template <class V>
void fields(V& v, const MeasureHello*) {
  v.constant("format", kMeasureFormat);
  v.field("version", &MeasureHello::version, {.text = json_fields::Text::label, .required = true}, "Of the program.");
  v.field("checks", &MeasureHello::checks, {.max_count = 1000, .text = json_fields::Text::label}, "That it has.");
}

Measurement measurement_of(const MeasureRequest& request, const Evaluation& evaluation, const Evaluator& evaluator) {
  Measurement measured;
  measured.id = request.id;
  measured.motion_hash = to_hex(evaluation.motion_hash);
  measured.frames = evaluation.frame_count;
  if (request.trace)
    for (const std::uint16_t step : motion_trace(evaluator.motion())) measured.trace += to_hex(step).substr(12);
  MarginsByName findings = deepest_findings(evaluation);
  if (request.margins) measured.margins = as_list(margins_without(findings, evaluator));
  measured.findings = as_list(std::move(findings));
  return measured;
}

Measurement measure(const MeasureRequest& request, Evaluator& evaluator) {
  const Result<Evaluation> evaluation = evaluator.run(request.spec, request.check);
  if (evaluation) return measurement_of(request, *evaluation, evaluator);
  Measurement refused;
  refused.id = request.id, refused.refusal = evaluation.issue();
  return refused;
}

MeasureHello own_hello(const std::string& version) {
  MeasureHello hello{version, {}};
  for (const CheckDef& check : all_checks())
    if (check.needs != Needs::clip) hello.checks.emplace_back(check.name);
  return hello;
}

std::string print_line(const MeasureRequest& request) {
  Json out = {{"spec", Json::parse(print_spec(request.spec))}};
  if (request.id != 0) out["id"] = request.id;
  if (!request.check.empty()) out["check"] = request.check;
  if (request.margins) out["margins"] = true;
  if (request.trace) out["trace"] = true;
  return json_fields::compact_text(out);
}

std::string print_line(const Measurement& measurement) {
  return json_fields::compact_text(json_fields::Codec<Measurement>::write(measurement, {}));
}

std::string print_line(const MeasureHello& hello) {
  return json_fields::compact_text(json_fields::Codec<MeasureHello>::write(hello, {}));
}

namespace {

Issue bad_request(const std::string& name, const std::string& expected) {
  return {"measure.bad_request", "/" + name, "expected " + expected};
}

// Reads the fields of a request other than its spec.
Result<Done> read_options(const Json& line, MeasureRequest& request) {
  for (const auto& [name, value] : line.items()) {
    if (name == "id" && value.is_number_integer())
      request.id = value.get<std::int64_t>();
    else if (name == "check" && value.is_string())
      request.check = value.get<std::string>();
    else if ((name == "margins" || name == "trace") && value.is_boolean())
      (name == "margins" ? request.margins : request.trace) = value.get<bool>();
    else if (name != "spec")
      return bad_request(name, "spec, id (a whole number), check (a text), margins or trace (true or false)");
  }
  const std::vector<std::string> checks = own_hello("").checks;
  if (!request.check.empty() && std::ranges::find(checks, request.check) == checks.end())
    return Issue{"measure.unknown_check", "/check", "there is no check " + json_fields::quoted(request.check)};
  return Done{};
}

}  // namespace

Result<MeasureRequest> parse_request(std::string_view line) {
  const Result<Json> tree = json_fields::parse_document(line);
  if (!tree) return tree.issue();
  MeasureRequest request;
  const bool is_bare = !tree->is_object() || !tree->contains("spec");
  if (!is_bare)
    if (const Result<Done> read = read_options(*tree, request); !read) return read.issue();
  Result<Spec> spec = parse_spec(is_bare ? line : json_fields::compact_text((*tree)["spec"]));
  if (!spec) return Issue{spec.issue().code, (is_bare ? "" : "/spec") + spec.issue().pointer, spec.issue().text};
  request.spec = std::move(spec).value();
  return request;
}

Result<Measurement> parse_measurement(std::string_view line) {
  Result<Measurement> read = json_fields::read_document<Measurement>(line, "measure");
  if (read && !read->refusal && read->motion_hash.empty())
    return Issue{"measure.bad_answer", "/motion_hash", "found nothing; only a refusal has no motion"};
  return read;
}

Result<MeasureHello> parse_hello(std::string_view line) {
  return json_fields::read_document<MeasureHello>(line, "measure");
}

}  // namespace contort
