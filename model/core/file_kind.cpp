#include "model/core/file_kind.h"

#include <algorithm>
#include <cctype>

#include "model/core/files.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using namespace std::string_view_literals;

struct Kind {
  std::size_t at;
  std::string_view magic;
  std::string_view name;
};

// From the formats' own specifications, and file(1). Longer marks come before those that they begin with.
constexpr Kind kKinds[] = {{0, "\x89PNG\r\n\x1a\n"sv, "a PNG image"},
                           {0, "\xff\xd8\xff"sv, "a JPEG image"},
                           {0, "GIF8"sv, "a GIF image"},
                           {8, "WEBP"sv, "a WebP image"},
                           {8, "WAVE"sv, "a WAV sound"},
                           {8, "AVI "sv, "an AVI film"},
                           {0, "II*\0"sv, "a TIFF image"},
                           {0, "MM\0*"sv, "a TIFF image"},
                           {0, "\x76\x2f\x31\x01"sv, "an OpenEXR image"},
                           {4, "ftyp"sv, "an MP4 or QuickTime film"},
                           {0, "\x1a\x45\xdf\xa3"sv, "a Matroska or WebM film"},
                           {0, "PK\x03\x04"sv, "a ZIP archive"},
                           {0, "PK\x05\x06"sv, "a ZIP archive"},
                           {0, "\x1f\x8b"sv, "a gzip archive"},
                           {0, "BZh"sv, "a bzip2 archive"},
                           {0, "\xfd\x37zXZ\0"sv, "an xz archive"},
                           {0, "\x28\xb5\x2f\xfd"sv, "a Zstandard archive"},
                           {0, "7z\xbc\xaf\x27\x1c"sv, "a 7-Zip archive"},
                           {0, "Rar!"sv, "a RAR archive"},
                           {257, "ustar"sv, "a tar archive"},
                           {0, "%PDF-"sv, "a PDF document"},
                           {0, "Kaydara FBX Binary"sv, "an FBX model"},
                           {0, "; FBX "sv, "an FBX model"},
                           {0, "PXR-USDC"sv, "a USD scene"},
                           {0, "#usda "sv, "a USD scene"},
                           {0, "glTF"sv, "a glTF model (GLB)"},
                           {0, "BLENDER"sv, "a Blender file"},
                           {0, "Ogawa"sv, "an Alembic file"},
                           {0, "\x89HDF\r\n"sv, "an HDF5 file"},
                           {0, "ply\n"sv, "a PLY model"},
                           {0, "HIERARCHY"sv, "a BVH animation"},
                           {0, "#!OML:ASF"sv, "an Acclaim motion file (ASF or AMC)"},
                           {0, "version https://git-lfs.github.com/spec/"sv,
                            "a Git LFS pointer, whose file is not here yet (git lfs pull gets it)"},
                           {0,
                            "\x7f"
                            "ELF"sv,
                            "a program (ELF)"},
                           {0, "#!/"sv, "a script"},
                           {0, "SQLite format 3"sv, "an SQLite database"},
                           {0, "\xff\xfe"sv, "a text in UTF-16, where UTF-8 is needed"},
                           {0, "\xfe\xff"sv, "a text in UTF-16, where UTF-8 is needed"}};

bool is_same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool begins_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), is_same_letter);
}

// The kind of a text in HTML or XML, which may begin with blank lines and names its kind a little later.
std::string_view kind_of_markup(std::string_view bytes) {
  std::string_view text = bytes.substr(0, 1024);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (begins_with(text, "<!doctype html") || begins_with(text, "<html")) return "an HTML page";
  if (!begins_with(text, "<?xml") && !begins_with(text, "<svg") && !begins_with(text, "<COLLADA")) return "";
  if (text.find("<COLLADA") != text.npos) return "a COLLADA model";
  if (text.find("<svg") != text.npos) return "an SVG image";
  return text.find("<html") != text.npos ? "an HTML page" : "an XML file";
}

Result<std::string> of_right_kind(Result<std::string> text, const std::string& path, const std::string& expected) {
  if (!text && text.issue().code != "file.too_large") return text;
  const std::optional<Issue> other = other_kind(path, text ? *text : beginning_of(path, 1024), expected);
  return other ? *other : std::move(text);
}

}  // namespace

std::string_view kind_of_bytes(std::string_view bytes) {
  for (const Kind& kind : kKinds)
    if (bytes.size() >= kind.at && bytes.substr(kind.at).starts_with(kind.magic)) return kind.name;
  return kind_of_markup(bytes);
}

std::optional<Issue> other_kind(const std::string& path, std::string_view bytes, const std::string& expected) {
  const std::string_view kind = kind_of_bytes(bytes);
  if (kind.empty()) return std::nullopt;
  return Issue{"file.wrong_kind", "", path + " is " + std::string(kind) + ", expected " + expected};
}

Result<std::string> read_json_file(const std::string& path, const std::string& expected) {
  return of_right_kind(read_file(path, json_fields::kMaxDocumentBytes), path, expected);
}

Result<std::string> read_named_json(const std::string& path, const std::string& expected) {
  return of_right_kind(read_named_file(path, json_fields::kMaxDocumentBytes), path, expected);
}

}  // namespace contort
