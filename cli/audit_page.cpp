#include "cli/audit_page.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "cli/render.h"
#include "model/core/files.h"
#include "renders/audit_html.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

constexpr std::size_t kMostReasonsOfRow = 3;  // greatest number of reasons for refusals in a row

std::string counts_text(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return text;
}

bool has_worst(const AuditRow& row) { return !(row.worst == Spec{}); }
bool can_be_drawn(const AuditRow& row) { return has_worst(row) && !row.worst_ends; }

AuditPageRow page_row(const AuditRow& row, bool has_picture) {
  const std::string object = object_of(row), name = file_name_of(row);
  AuditPageRow out;
  out.character = row.character.name;
  out.part = row.slot + (row.character.parts.empty() ? "" : " (" + row.part + ")") + (object.empty() ? "" : ", " + object);
  out.action = row.action + (row.point.empty() ? "" : " " + row.point);
  out.draws = row.draws, out.clean = row.clean, out.unmet = row.unmet, out.still = row.still;
  out.details = details_of(row);
  if (has_worst(row)) out.spec = "motions/" + name + ".json";
  if (can_be_drawn(row) && has_picture) out.picture = "pictures/" + name + ".png";
  return out;
}

// Returns true if there are pictures.
bool draw_pictures(const std::string& folder, const std::vector<AuditRow>& rows, Context& context) {
  if (context.gl == "none") return false;
  std::vector<StripFile> strips;
  for (const AuditRow& row : rows)
    if (can_be_drawn(row))
      strips.push_back({folder + "/motions/" + file_name_of(row) + ".json", folder + "/pictures/" + file_name_of(row) + ".png"});
  if (draw_strips(strips, {"--tiles", "4"}, context, [] {}) == 0) return true;
  std::fprintf(stderr, "contort: some pictures are missing; the page is complete without them\n");
  context.exit_code = kInternal;
  return true;
}

}  // namespace

std::string object_of(const AuditRow& row) {
  if (row.character.attachments.empty()) return "";
  const AttachmentDesc& object = row.character.attachments.front();
  return object.object + " at " + object.slot + "/" + object.socket;
}

std::string file_name_of(const AuditRow& row) {
  std::string name = row.character.name + "-" + row.slot;
  if (!row.character.parts.empty()) name += "-" + row.part;
  name += "-" + row.action;
  if (!row.point.empty()) name += "-" + row.point;
  for (const AttachmentDesc& object : row.character.attachments)
    name += "-" + object.object + "-" + object.slot + "-" + object.socket;
  return name;
}

namespace {

// Text such as "refused: the angle is too large 12, there are too many swings 3".
std::string refusals_text(const AuditRow& row) {
  if (row.refused == 0) return "";
  std::string text;
  std::vector<RefusalCount> counts = by_frequency(row.refusals);
  counts.resize(std::min(counts.size(), kMostReasonsOfRow));
  for (const RefusalCount& count : counts)
    text += (text.empty() ? "refused: " : ", ") + one_line(count.text) + " " + std::to_string(count.cases);
  return text;
}

}  // namespace

std::string details_of(const AuditRow& row) {
  const std::string findings = counts_text(row.findings), reasons = counts_text(row.reasons);
  std::vector<std::string> details = {findings, reasons.empty() ? "" : "unmet: " + reasons, refusals_text(row)};
  for (const auto& [check, sentence] : row.endings) details.push_back(check + ": " + one_line(sentence));
  if (row.is_cut)
    details.push_back("no further motions were made after " + std::to_string(kMostTimeouts) + " that took too long");
  std::string text;
  for (const std::string& detail : details)
    if (!detail.empty()) text += (text.empty() ? "" : "; ") + detail;
  return text;
}

Result<Done> write_worst(const std::string& folder, const std::vector<AuditRow>& rows) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Issue{"file.unwritable", "", folder + ": " + error.message()};
  for (const AuditRow& row : rows) {
    if (!has_worst(row)) continue;
    const std::string path = folder + "/" + file_name_of(row) + ".json";
    if (const Result<Done> written = write_file(path, pretty_spec(row.worst)); !written) return written.issue();
  }
  return Done{};
}

Result<Done> write_audit_page(const std::string& folder, const std::string& command, const std::vector<AuditRow>& rows,
                              Context& context) {
  if (const Result<Done> written = write_worst(folder + "/motions", rows); !written) return written.issue();
  std::error_code error;
  std::filesystem::create_directories(folder + "/pictures", error);
  if (error) return Issue{"file.unwritable", "", folder + ": " + error.message()};
  const bool has_pictures = draw_pictures(folder, rows, context);
  AuditPage page{command, CONTORT_VERSION, {}};
  for (const AuditRow& row : rows) page.rows.push_back(page_row(row, has_pictures));
  return write_file(folder + "/index.html", audit_html(page));
}

}  // namespace contort::cli
