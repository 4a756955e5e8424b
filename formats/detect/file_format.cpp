#include "formats/detect/file_format.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "formats/gltf/container.h"
#include "formats/mocap/words.h"
#include "formats/table/joint_table.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

struct Ending {
  std::string_view text;
  FileFormat format;
};
constexpr std::array<Ending, 8> kEndings = {{{".glb", FileFormat::gltf},
                                             {".gltf", FileFormat::gltf},
                                             {".vrm", FileFormat::gltf},
                                             {".vrma", FileFormat::gltf},
                                             {".bvh", FileFormat::bvh},
                                             {".amc", FileFormat::amc},
                                             {".csv", FileFormat::joint_table},
                                             {".tsv", FileFormat::joint_table}}};

std::string_view without_mark_and_blanks(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

// Acclaim's files begin with comments. The first word after them opens a section.
FileFormat acclaim_format(std::string_view text) {
  while (text.starts_with('#')) {
    text.remove_prefix(std::min(text.find('\n'), text.size()));
    text = without_mark_and_blanks(text);
  }
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  const auto is_one_of = [&](auto... names) { return (is_same_word(word, names) || ...); };
  if (is_one_of(":version", ":name", ":units", ":documentation", ":root")) return FileFormat::asf;
  return is_one_of(":fully-specified", ":degrees") ? FileFormat::amc : FileFormat::none;
}

// Searches the whole text for "asset", which may be its last key, before parsing, which takes longer.
bool is_gltf_text(const std::string& path) {
  const Result<std::string> text = read_file(path, json_fields::kMaxDocumentBytes);
  if (!text || text->find("\"asset\"") == text->npos || !scan_json(*text)) return false;
  const Result<Json> tree = json_fields::parse_document(*text);
  if (!tree || !tree->is_object() || !tree->contains("asset")) return false;
  const Json& asset = (*tree)["asset"];
  return asset.is_object() && asset.contains("version");
}

}  // namespace

FileFormat format_of_bytes(std::string_view bytes) {
  if (is_glb(std::as_bytes(std::span(bytes)))) return FileFormat::gltf;
  const std::string_view text = without_mark_and_blanks(bytes);
  if (is_same_word(text.substr(0, text.find_first_of(" \t\r\n")), "HIERARCHY")) return FileFormat::bvh;
  if (const FileFormat acclaim = acclaim_format(text); acclaim != FileFormat::none) return acclaim;
  return is_joint_table(bytes) ? FileFormat::joint_table : FileFormat::none;
}

FileFormat format_of_ending(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const auto found = std::ranges::find_if(kEndings, [&](const Ending& e) { return is_same_word(ending, e.text); });
  return found == kEndings.end() ? FileFormat::none : found->format;
}

FileFormat format_of_file(const std::string& path) {
  const std::string beginning = beginning_of(path, kKindBytes);
  if (const FileFormat held = format_of_bytes(beginning); held != FileFormat::none) return held;
  if (const FileFormat named = format_of_ending(path); named != FileFormat::none) return named;
  const bool is_object = without_mark_and_blanks(beginning).starts_with('{');
  return is_object && is_gltf_text(path) ? FileFormat::gltf : FileFormat::none;
}

}  // namespace contort
