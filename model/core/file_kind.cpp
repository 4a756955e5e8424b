#include "model/core/file_kind.h"

#include <algorithm>
#include <cctype>

#include "model/core/files.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using namespace std::string_view_literals;

constexpr std::size_t kShown = 40;  // greatest number of bytes of an unknown file in a message

struct Kind {
  std::size_t at;
  std::string_view magic;
  std::string_view name;
  std::string_view advice{};  // a clause with a remedy, for kinds that people take for motion
};

constexpr std::string_view kExport = "export it as glTF (.glb), as Blender and most other editors can";
constexpr std::string_view kUnpack = "unpack it first, and name a file in it";
constexpr std::string_view kRobot = "a robot's description has no animation";
constexpr std::string_view kNumbers = "numbers without a skeleton are no animation: write them as .bvh or .glb";
constexpr std::string_view kTables =
    "contort check FILE.csv --character NAME judges values of joints, with a column of times";
constexpr std::string_view kDownload = "the download went wrong: fetch the file itself";

// The marks come from the formats' specifications and from file(1). A longer mark comes before a shorter one with the
// same beginning.
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
                           {0, "PK\x05\x06"sv, "a ZIP archive", kUnpack},
                           {0, "\x1f\x8b"sv, "a gzip archive", kUnpack},
                           {0, "BZh"sv, "a bzip2 archive", kUnpack},
                           {0, "\xfd\x37zXZ\0"sv, "an xz archive", kUnpack},
                           {0, "\x28\xb5\x2f\xfd"sv, "a Zstandard archive", kUnpack},
                           {0, "7z\xbc\xaf\x27\x1c"sv, "a 7-Zip archive", kUnpack},
                           {0, "Rar!"sv, "a RAR archive", kUnpack},
                           {257, "ustar"sv, "a tar archive", kUnpack},
                           {0, "%PDF-"sv, "a PDF document"},
                           {0, "Kaydara FBX Binary"sv, "an FBX model", kExport},
                           {0, "; FBX "sv, "an FBX model", kExport},
                           {0, "PXR-USDC"sv, "a USD scene", kExport},
                           {0, "#usda "sv, "a USD scene", kExport},
                           {0, "glTF"sv, "a glTF model (GLB)"},
                           {0, "BLENDER"sv, "a Blender file", kExport},
                           {0, "Ogawa"sv, "an Alembic file", kExport},
                           {0, "\x89HDF\r\n"sv, "an HDF5 file", kNumbers},
                           {0, "\x93NUMPY"sv, "a NumPy array (NPY)", kNumbers},
                           {0, "\x80\x02}"sv, "a Python pickle", kNumbers},
                           {0, "\x80\x03}"sv, "a Python pickle", kNumbers},
                           {0, "\x80\x04\x95"sv, "a Python pickle", kNumbers},
                           {0, "\x80\x05\x95"sv, "a Python pickle", kNumbers},
                           {0, "\x02P"sv, "a C3D file of markers", "markers are no skeleton: solve it and export .bvh"},
                           {0, "PathFileType"sv, "a TRC file of markers", "solve it and export .bvh"},
                           {0, "Vocaloid Motion Data"sv, "an MMD motion (VMD)", kExport},
                           {0, "Pmx "sv, "an MMD model (PMX)", kExport},
                           {0, "%YAML"sv, "a YAML text, as Unity writes", kExport},
                           {0, "ply\n"sv, "a PLY model"},
                           {0, "HIERARCHY"sv, "a BVH animation"},
                           {0, "#!OML:ASF"sv, "an Acclaim motion file (ASF or AMC)"},
                           {0, "version https://git-lfs.github.com/spec/"sv,
                            "a Git LFS pointer, whose file is not here yet", "run git lfs pull, which gets it"},
                           {0, "404: Not Found"sv, "a web server's answer that there is no such file", kDownload},
                           {0,
                            "\x7f"
                            "ELF"sv,
                            "a program (ELF)"},
                           {0, "#!/"sv, "a script"},
                           {0, "SQLite format 3"sv, "an SQLite database"},
                           {0, "\xff\xfe"sv, "a text in UTF-16, where UTF-8 is needed"},
                           {0, "\xfe\xff"sv, "a text in UTF-16, where UTF-8 is needed"}};

// Archives are told apart by their first entry.
constexpr Kind kZip = {0, "PK\x03\x04"sv, "a ZIP archive", kUnpack};
constexpr Kind kUsdz = {0, {}, "a USD scene (USDZ)", kExport};
constexpr Kind kNpz = {0, {}, "a ZIP archive of NumPy arrays (NPZ)", kNumbers};

// Kinds by the root element of a text in XML or HTML.
constexpr Kind kElements[] = {{0, "<html", "an HTML page", kDownload},
                              {0, "<!doctype html", "an HTML page", kDownload},
                              {0, "<head", "an HTML page", kDownload},
                              {0, "<COLLADA", "a COLLADA model", kExport},
                              {0, "<svg", "an SVG image"},
                              {0, "<robot", "a robot in URDF", kRobot},
                              {0, "<sdf", "a robot in SDF", kRobot},
                              {0, "<mujoco", "a robot in MJCF (MuJoCo)", kRobot}};
// Kinds by the ending of the file's name, for contents that are not recognised.
struct Named {
  std::string_view ending;
  std::string_view name;
};
constexpr Named kNamed[] = {{".fbx", "an FBX model"},    {".usd", "a USD scene"},      {".usda", "a USD scene"},
                            {".usdc", "a USD scene"},    {".usdz", "a USD scene"},     {".npz", "NumPy arrays (NPZ)"},
                            {".npy", "a NumPy array"},   {".csv", "a table (CSV)"},    {".zip", "a ZIP archive"},
                            {".urdf", "a robot (URDF)"}, {".pkl", "a Python pickle"},  {".dae", "a COLLADA model"},
                            {".c3d", "markers (C3D)"},   {".blend", "a Blender file"}, {".xml", "an XML file"}};
constexpr Kind kXml = {0, {}, "an XML file"};
constexpr Kind kTable = {0, {}, kTableKind, kTables};

bool is_same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool begins_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(), is_same_letter);
}

bool ends_with(std::string_view text, std::string_view word) {
  return text.size() >= word.size() && begins_with(text.substr(text.size() - word.size()), word);
}

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

// The text from the root element on, after declarations and comments. Empty if the text does not begin with markup.
std::string_view root_element(std::string_view text) {
  text = without_blanks(text);
  while (text.starts_with("<?") || text.starts_with("<!--")) {
    const std::string_view close = text.starts_with("<?") ? "?>" : "-->";
    const std::size_t end = text.find(close);
    text = end == text.npos ? std::string_view() : without_blanks(text.substr(end + close.size()));
  }
  return text.starts_with('<') ? text : std::string_view();
}

const Kind* kind_of_markup(std::string_view text) {
  const std::string_view root = root_element(text);
  for (const Kind& kind : kElements)
    if (begins_with(root, kind.magic)) return &kind;
  // A document type may stand before the root, so the root is searched for in the text.
  const bool is_xml = begins_with(without_blanks(text), "<?xml") || begins_with(root, "<!doctype");
  for (const Kind& kind : kElements)
    if (is_xml && text.find(kind.magic) != text.npos) return &kind;
  return is_xml ? &kXml : nullptr;
}

// The first entry's name begins at byte 30; its length is at byte 26 (PKWARE's APPNOTE, 4.3.7).
const Kind& kind_of_zip(std::string_view bytes) {
  if (bytes.size() < 30) return kZip;
  const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])); };
  const std::string_view name = bytes.substr(30, byte(26) + 256 * byte(27));
  if (name.ends_with(".npy")) return kNpz;
  return name.ends_with(".usd") || name.ends_with(".usda") || name.ends_with(".usdc") ? kUsdz : kZip;
}

bool is_row_of_numbers(std::string_view line) {
  return line.find_first_of(",;\t") != line.npos && line.find_first_of("0123456789") != line.npos &&
         line.find_first_not_of("0123456789+-.eE,; \t\r") == line.npos;
}

// Returns true if a line of names or numbers is followed by a line of numbers with as many separators.
bool is_table(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == text.npos || text.find_first_of("{[<") < end) return false;
  const std::string_view first = text.substr(0, end), rest = text.substr(end + 1);
  const std::string_view second = rest.substr(0, rest.find('\n'));
  if (!is_row_of_numbers(second)) return false;
  const char separator = second[second.find_first_of(",;\t")];
  return std::ranges::count(first, separator) == std::ranges::count(second, separator);
}

const Kind* find_kind(std::string_view bytes) {
  if (bytes.starts_with(kZip.magic)) return &kind_of_zip(bytes);
  for (const Kind& kind : kKinds)
    if (bytes.size() >= kind.at && bytes.substr(kind.at).starts_with(kind.magic)) return &kind;
  std::string_view text = bytes.substr(0, kKindBytes);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  if (const Kind* markup = kind_of_markup(text)) return markup;
  return is_table(text) ? &kTable : nullptr;
}

Result<std::string> of_right_kind(Result<std::string> text, const std::string& path, const std::string& expected) {
  if (!text && text.issue().code != "file.too_large") return text;
  const std::optional<Issue> other = other_kind(path, text ? *text : beginning_of(path, kKindBytes), expected);
  return other ? *other : std::move(text);
}

}  // namespace

std::string_view kind_of_bytes(std::string_view bytes) {
  const Kind* kind = find_kind(bytes);
  return kind == nullptr ? std::string_view() : kind->name;
}

bool has_advice(std::string_view bytes) {
  const Kind* kind = find_kind(bytes);
  return kind != nullptr && !kind->advice.empty();
}

std::optional<Issue> other_kind(const std::string& path, std::string_view bytes, const std::string& expected) {
  const Kind* kind = find_kind(bytes);
  if (kind == nullptr) return std::nullopt;
  if (kind == &kZip && ends_with(path, ".usdz")) kind = &kUsdz;
  if (kind == &kZip && ends_with(path, ".npz")) kind = &kNpz;
  const std::string advice = kind->advice.empty() ? "" : "; " + std::string(kind->advice);
  return Issue{"file.wrong_kind", "", path + " is " + std::string(kind->name) + ", expected " + expected + advice};
}

Issue unknown_kind(const std::string& path, std::string_view bytes, const std::string& expected) {
  if (const std::optional<Issue> other = other_kind(path, bytes, expected)) return *other;
  const std::string begins = bytes.empty() ? "is empty" : "begins with " + json_fields::quoted(std::string(
                                                              bytes.substr(0, std::min(bytes.find('\n'), kShown))));
  for (const Named& named : kNamed)
    if (ends_with(path, named.ending))
      return {"file.wrong_kind", "",
              path + " is named like " + std::string(named.name) + ", and " + begins + "; expected " + expected};
  return {"file.wrong_kind", "", path + " " + begins + ", expected " + expected};
}

Result<std::string> read_json_file(const std::string& path, const std::string& expected) {
  return of_right_kind(read_file(path, json_fields::kMaxDocumentBytes), path, expected);
}

Result<std::string> read_named_json(const std::string& path, const std::string& expected) {
  return of_right_kind(read_named_file(path, json_fields::kMaxDocumentBytes), path, expected);
}

}  // namespace contort
