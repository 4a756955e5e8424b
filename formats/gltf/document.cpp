#include "formats/gltf/document.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "formats/gltf/extension_fields.h"
#include "formats/gltf/limits.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

// ---- glTF's rules for the properties that we read; all others are removed

enum class Kind { text, flag, integer, index, index_list, number_list, text_list, object, object_list };

struct Field {
  std::string_view key;
  Kind kind = Kind::text;
  bool required = false;
  std::int64_t low = 0;       // Least value of an integer; fewest entries of a list.
  std::int64_t high = 0;      // Greatest value of an integer; most bytes of a text; most entries of a list.
  std::string_view target{};  // The target of an index: the list at the document's root that it points into.
  std::span<const Field> fields{};
};

// Fits a double, and sums of a few do not overflow. The real bounds are checked against the buffers (accessor.cpp).
constexpr std::int64_t kMaxOffset = std::int64_t{1} << 53;
constexpr std::int64_t kMaxInt = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kAnyCount = static_cast<std::int64_t>(kMaxGltfValues);

constexpr bool kRequired = true;
constexpr Field text(std::string_view key, bool required = false, std::int64_t most_bytes = kMaxGltfNameBytes) {
  return {key, Kind::text, required, 0, most_bytes};
}
constexpr Field flag(std::string_view key) { return {key, Kind::flag}; }
constexpr Field integer(std::string_view key, std::int64_t low, std::int64_t high, bool required = false) {
  return {key, Kind::integer, required, low, high};
}
constexpr Field index(std::string_view key, std::string_view target, bool required = false) {
  return {key, Kind::index, required, 0, 0, target};
}
constexpr Field index_list(std::string_view key, std::string_view target, bool required = false) {
  return {key, Kind::index_list, required, required ? 1 : 0, kAnyCount, target};
}
constexpr Field numbers(std::string_view key, std::int64_t count) {
  return {key, Kind::number_list, false, count, count};
}
constexpr Field object(std::string_view key, std::span<const Field> fields, bool required = false) {
  return {key, Kind::object, required, 0, 0, {}, fields};
}
constexpr Field objects(std::string_view key, std::span<const Field> fields, bool required = false,
                        std::int64_t most = kAnyCount) {
  return {key, Kind::object_list, required, 0, most, {}, fields};
}

constexpr Field kAsset[] = {text("version", kRequired), text("minVersion")};
constexpr Field kScene[] = {index_list("nodes", "nodes")};
constexpr Field kNode[] = {text("name"),
                           index_list("children", "nodes"),
                           index("mesh", "meshes"),
                           index("skin", "skins"),
                           index("camera", "cameras"),
                           numbers("translation", 3),
                           numbers("rotation", 4),
                           numbers("scale", 3),
                           numbers("matrix", 16)};
constexpr Field kSkin[] = {text("name"), index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                           index_list("joints", "nodes", kRequired)};
constexpr Field kTarget[] = {index("node", "nodes"), text("path", kRequired)};
// The index of a channel's sampler refers to its own animation, so clips.cpp checks it.
constexpr Field kChannel[] = {integer("sampler", 0, kMaxInt, kRequired), object("target", kTarget, kRequired)};
constexpr Field kSampler[] = {index("input", "accessors", kRequired), index("output", "accessors", kRequired),
                              text("interpolation")};
constexpr Field kAnimation[] = {text("name"), objects("channels", kChannel, kRequired),
                                objects("samplers", kSampler, kRequired)};
constexpr Field kSparseIndices[] = {index("bufferView", "bufferViews", kRequired), integer("byteOffset", 0, kMaxInt),
                                    integer("componentType", 5121, 5125, kRequired)};
constexpr Field kSparseValues[] = {index("bufferView", "bufferViews", kRequired), integer("byteOffset", 0, kMaxInt)};
constexpr Field kSparse[] = {integer("count", 1, kMaxInt, kRequired), object("indices", kSparseIndices, kRequired),
                             object("values", kSparseValues, kRequired)};
// The standard forbids 0 elements, but their only meaning is harmless: nothing. Files with empty channels have such
// accessors.
constexpr Field kAccessor[] = {index("bufferView", "bufferViews"),
                               integer("byteOffset", 0, kMaxOffset),
                               integer("componentType", 5120, 5126, kRequired),
                               flag("normalized"),
                               integer("count", 0, kMaxOffset, kRequired),
                               text("type", kRequired),
                               object("sparse", kSparse)};
constexpr Field kBufferView[] = {index("buffer", "buffers", kRequired), integer("byteOffset", 0, kMaxOffset),
                                 integer("byteLength", 1, kMaxOffset, kRequired), integer("byteStride", 4, 252)};
constexpr Field kBuffer[] = {integer("byteLength", 1, kMaxOffset, kRequired),
                             text("uri", false, static_cast<std::int64_t>(2 * kMaxGltfBytes))};
constexpr Field kAttributes[] = {index("POSITION", "accessors"), index("JOINTS_0", "accessors"),
                                 index("WEIGHTS_0", "accessors"), index("JOINTS_1", "accessors"),
                                 index("WEIGHTS_1", "accessors")};
constexpr Field kPrimitive[] = {object("attributes", kAttributes, kRequired), index("indices", "accessors"),
                                integer("mode", 0, 6)};
constexpr Field kMesh[] = {objects("primitives", kPrimitive, kRequired)};
constexpr Field kRoot[] = {object("asset", kAsset, kRequired),
                           {"extensionsRequired", Kind::text_list, false, 0, 1000},
                           index("scene", "scenes"),
                           objects("scenes", kScene),
                           objects("nodes", kNode, false, kMaxGltfNodes),
                           objects("skins", kSkin),
                           objects("animations", kAnimation),
                           objects("accessors", kAccessor),
                           objects("bufferViews", kBufferView),
                           objects("buffers", kBuffer),
                           objects("meshes", kMesh)};  // last: only read on request

// ---- checking against the tables

// The checker's position in the document. It is printed only in messages.
struct Place {
  const Place* parent = nullptr;
  std::string_view key;
  std::int64_t index = -1;
};

std::string pointer_to(const Place& place) {
  if (place.parent == nullptr) return "";
  return pointer_to(*place.parent) + "/" + (place.index < 0 ? std::string(place.key) : std::to_string(place.index));
}

// A value as short plain ASCII text in one line, for messages.
std::string shown(const Json& value) {
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  const bool is_long = value.is_string() && value.get_ref<const std::string&>().size() > 40;
  if (is_long) return "a text of " + std::to_string(value.get_ref<const std::string&>().size()) + " bytes";
  return value.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Issue issue(std::string_view code, const Place& place, const Json& found, const std::string& allowed) {
  return {"gltf." + std::string(code), pointer_to(place), "found " + shown(found) + "; allowed is " + allowed};
}

std::string from_to(std::int64_t low, std::int64_t high) { return std::to_string(low) + " to " + std::to_string(high); }

class Checker {
 public:
  explicit Checker(const Json& root) {
    for (const auto& [key, value] : root.items())
      if (value.is_array()) sizes_[key] = static_cast<std::int64_t>(value.size());
  }

  Result<Done> check_object(Json& value, std::span<const Field> fields, const Place& place) const {
    if (!value.is_object()) return issue("wrong_type", place, value, "an object");
    remove_unknown(value, fields);
    for (const Field& field : fields) {
      const auto found = value.find(field.key);
      if (found == value.end()) {
        if (!field.required) continue;
        return Issue{"gltf.missing", pointer_to(place), "\"" + std::string(field.key) + "\" is required"};
      }
      if (const auto checked = check(*found, field, {&place, field.key}); !checked) return checked.issue();
    }
    return Done{};
  }

 private:
  static void remove_unknown(Json& value, std::span<const Field> fields) {
    for (auto it = value.begin(); it != value.end();) {
      const bool known = std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.key == it.key(); });
      it = known ? std::next(it) : value.erase(it);
    }
  }

  Result<Done> check(Json& value, const Field& field, const Place& place) const {
    switch (field.kind) {
      case Kind::text: return check_text(value, field.high, place);
      case Kind::flag:
        return value.is_boolean() ? Result<Done>(Done{}) : issue("wrong_type", place, value, "true or false");
      case Kind::integer: return check_integer(value, field, place);
      case Kind::index: return check_index(value, field, place);
      case Kind::object: return check_object(value, field.fields, place);
      default: return check_list(value, field, place);
    }
  }

  static Result<Done> check_text(const Json& value, std::int64_t most_bytes, const Place& place) {
    if (!value.is_string()) return issue("wrong_type", place, value, "a text");
    if (value.get_ref<const std::string&>().size() > static_cast<std::size_t>(most_bytes))
      return issue("too_large", place, value, "a text of at most " + std::to_string(most_bytes) + " bytes");
    return Done{};
  }

  // 5126.0 is an integer, as in JSON Schema. tinygltf does not accept it, so it is rewritten.
  static bool make_integer(Json& value) {
    if (!value.is_number()) return false;
    const double number = value.get<double>();
    if (std::floor(number) != number || std::fabs(number) > static_cast<double>(kMaxOffset)) return false;
    value = static_cast<std::int64_t>(number);
    return true;
  }

  static Result<Done> check_integer(Json& value, const Field& field, const Place& place) {
    const std::string allowed = "an integer from " + from_to(field.low, field.high);
    if (!value.is_number()) return issue("wrong_type", place, value, allowed);
    const Json found = value;
    if (!make_integer(value)) return issue("out_of_range", place, found, allowed);
    const auto number = value.get<std::int64_t>();
    if (number < field.low || number > field.high) return issue("out_of_range", place, found, allowed);
    return Done{};
  }

  Result<Done> check_index(Json& value, const Field& field, const Place& place) const {
    const auto size = sizes_.find(field.target);
    const std::int64_t count = size == sizes_.end() ? 0 : size->second;
    const std::string list = "the index of one of the " + std::to_string(count) + " " + std::string(field.target);
    const Json found = value;
    if (!value.is_number()) return issue("wrong_type", place, value, list);
    if (!make_integer(value)) return issue("bad_index", place, found, list);
    const auto number = value.get<std::int64_t>();
    if (number < 0 || number >= count) return issue("bad_index", place, found, list);
    return Done{};
  }

  Result<Done> check_list(Json& value, const Field& field, const Place& place) const {
    const auto size = static_cast<std::int64_t>(value.size());
    const std::string allowed =
        "a list with " +
        (field.high == kAnyCount ? "at least " + std::to_string(field.low) : from_to(field.low, field.high)) +
        " entries";
    if (!value.is_array()) return issue("wrong_type", place, value, allowed);
    if (size > field.high) return issue("too_large", place, value, allowed);
    if (size < field.low) return issue("out_of_range", place, value, allowed);
    std::int64_t i = 0;
    for (Json& entry : value) {
      const Place here{&place, {}, i++};
      if (const auto checked = check_entry(entry, field, here); !checked) return checked.issue();
    }
    return Done{};
  }

  Result<Done> check_entry(Json& entry, const Field& list, const Place& place) const {
    if (list.kind == Kind::index_list) return check_index(entry, list, place);
    if (list.kind == Kind::object_list) return check_object(entry, list.fields, place);
    if (list.kind == Kind::text_list) return check_text(entry, kMaxGltfNameBytes, place);
    if (!entry.is_number()) return issue("wrong_type", place, entry, "a number");
    return Done{};
  }

  std::map<std::string, std::int64_t, std::less<>> sizes_;
};

// ---- rules that the tables cannot express

Result<Json> parse(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    return Issue{"gltf.bad_json", "", "the JSON text breaks off or has an error at byte " + std::to_string(error.byte)};
  } catch (const Json::out_of_range&) {
    return Issue{"gltf.not_finite", "", "the JSON text has a number that no 64-bit float can hold"};
  }
}

// Reads the digits before and after one dot; they must be small enough to compare.
bool read_version(const std::string& text, int& major, int& minor) {
  const std::size_t dot = text.find('.');
  const auto digits = [](std::string_view t) {
    return !t.empty() && t.size() <= 4 && std::all_of(t.begin(), t.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  if (dot == std::string::npos || !digits(text.substr(0, dot)) || !digits(text.substr(dot + 1))) return false;
  major = std::stoi(text.substr(0, dot));
  minor = std::stoi(text.substr(dot + 1));
  return true;
}

// Any 2.x may be read as 2.0, unless the file requires a newer reader.
Result<Done> check_version(const Json& asset) {
  int major = 0;
  int minor = 0;
  const std::string version = asset["version"];
  if (!read_version(version, major, minor) || major != 2)
    return Issue{"gltf.unsupported", "/asset/version", "found " + shown(version) + "; allowed is 2.0"};
  const std::string least = asset.value("minVersion", "2.0");
  if (!read_version(least, major, minor) || major != 2 || minor != 0)
    return Issue{"gltf.unsupported", "/asset/minVersion", "found " + shown(least) + "; allowed is 2.0"};
  return Done{};
}

Result<Done> check_extensions(const Json& root) {
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return Done{};
  for (std::size_t i = 0; i < required->size(); ++i)
    if (const Json& name = (*required)[i]; !is_known_extension(name.get_ref<const std::string&>()))
      return Issue{"gltf.unsupported", "/extensionsRequired/" + std::to_string(i),
                   "the file cannot be read without the extension " + shown(name) + ", which is not supported"};
  return Done{};
}

Result<Done> check_nodes(const Json& root) {
  const auto nodes = root.find("nodes");
  if (nodes == root.end()) return Done{};
  for (std::size_t i = 0; i < nodes->size(); ++i) {
    const Json& node = (*nodes)[i];
    if (node.contains("matrix") &&
        (node.contains("translation") || node.contains("rotation") || node.contains("scale")))
      return Issue{"gltf.bad_node", "/nodes/" + std::to_string(i),
                   "found a matrix together with translation, rotation or scale; allowed is one or the other"};
  }
  return Done{};
}

Result<Done> check_strides(const Json& root) {
  const auto views = root.find("bufferViews");
  if (views == root.end()) return Done{};
  for (std::size_t i = 0; i < views->size(); ++i)
    if (const auto stride = (*views)[i].value("byteStride", std::int64_t{4}); stride % 4 != 0)
      return Issue{"gltf.out_of_range", "/bufferViews/" + std::to_string(i) + "/byteStride",
                   "found " + std::to_string(stride) + "; allowed is a multiple of 4"};
  return Done{};
}

std::vector<BufferRef> take_buffers(Json& root) {
  std::vector<BufferRef> out;
  const auto buffers = root.find("buffers");
  if (buffers == root.end()) return out;
  for (Json& buffer : *buffers) {
    const bool has_uri = buffer.contains("uri");
    out.push_back({has_uri ? std::move(buffer["uri"].get_ref<std::string&>()) : "", has_uri,
                   buffer["byteLength"].get<std::uint64_t>()});
  }
  root.erase("buffers");
  return out;
}

// tinygltf drops a channel without a target node, which would change the number of every later channel.
void mark_channels_without_node(Json& root) {
  if (!root.contains("animations")) return;
  for (Json& animation : root["animations"])
    for (Json& channel : animation["channels"])
      if (!channel["target"].contains("node")) channel["target"]["node"] = -1;
}

}  // namespace

Result<GltfDocument> check_document(std::string_view text, Meshes meshes) {
  Result<Json> parsed = parse(text);
  if (!parsed) return parsed.issue();
  Json root = std::move(parsed).value();
  Result<GltfExtensions> extensions = take_extensions(root, meshes == Meshes::read);
  if (!extensions) return extensions.issue();
  const Place top;
  const std::span<const Field> known(kRoot, std::size(kRoot) - (meshes == Meshes::read ? 0 : 1));
  if (const auto checked = Checker(root).check_object(root, known, top); !checked) return checked.issue();
  for (const auto& checked :
       {check_version(root["asset"]), check_extensions(root), check_nodes(root), check_strides(root)})
    if (!checked) return checked.issue();
  GltfDocument out;
  out.extensions = std::move(extensions).value();
  out.buffers = take_buffers(root);
  mark_channels_without_node(root);
  out.json = root.dump();
  return out;
}

}  // namespace contort
