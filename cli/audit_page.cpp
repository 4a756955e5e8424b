#include "cli/audit_page.h"

#include <cstdio>
#include <filesystem>

#include "cli/render.h"
#include "model/core/files.h"
#include "renders/audit_html.h"

namespace contort::cli {

namespace {

std::string counts_text(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return text;
}

bool has_worst(const AuditRow& row) { return !(row.worst == Spec{}); }

AuditPageRow page_row(const AuditRow& row, bool has_picture) {
  const std::string object = object_of(row), name = file_name_of(row);
  AuditPageRow out;
  out.character = row.character.name;
  out.part = row.slot + (row.character.parts.empty() ? "" : " (" + row.part + ")") + (object.empty() ? "" : ", " + object);
  out.action = row.action + (row.point.empty() ? "" : " " + row.point);
  out.draws = row.draws, out.clean = row.clean, out.unmet = row.unmet, out.still = row.still;
  out.details = details_of(row);
  if (has_worst(row)) out.spec = "motions/" + name + ".json";
  if (has_worst(row) && has_picture) out.picture = "pictures/" + name + ".png";
  return out;
}

// Answers whether pictures are there.
bool draw_pictures(const std::string& folder, const std::vector<AuditRow>& rows, Context& context) {
  if (context.gl == "none") return false;
  std::vector<StripFile> strips;
  for (const AuditRow& row : rows)
    if (has_worst(row))
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

std::string details_of(const AuditRow& row) {
  const std::string findings = counts_text(row.findings), reasons = counts_text(row.reasons);
  return findings + (findings.empty() || reasons.empty() ? "" : "; ") + (reasons.empty() ? "" : "unmet: " + reasons);
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
