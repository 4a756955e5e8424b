// One hostile file per rule, each made by one change to a good one. The list follows the 106 malformed files on which
// tinygltf alone, or a trusting reader behind it, crashed, hung or read other people's files.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>
#include <limits>

#include "formats/gltf/limits.h"
#include "formats/gltf/read.h"
#include "tests/gltf/glb_builder.h"

namespace contort {
namespace {

using fixtures::ByteList;
using fixtures::GlbBuilder;
using fixtures::Json;
using fixtures::pack_glb;
using fixtures::small_arm;

struct Hostile {
  const char* name;
  std::function<void(GlbBuilder&)> change;
  const char* code;
  const char* pointer;
};

// Accessors of small_arm: 0 bind matrices, 1 and 2 times and rotations of "wave", 3 and 4 times and places of "push".
void set_float(GlbBuilder& b, std::size_t view, std::size_t index, float value) {
  const std::size_t offset = b.root["bufferViews"][view]["byteOffset"];
  std::memcpy(b.bin.data() + offset + 4 * index, &value, 4);
}

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

const Hostile kHostile[] = {
    // The nodes are no forest.
    {"node is its own child", [](GlbBuilder& b) { b.root["nodes"][3]["children"] = {3}; }, "gltf.cycle", "/nodes/3"},
    {"long cycle", [](GlbBuilder& b) { b.root["nodes"][2]["children"] = {0}; }, "gltf.cycle", "/nodes/0"},
    {"two parents", [](GlbBuilder& b) { b.root["nodes"][3]["children"] = {2}; }, "gltf.two_parents",
     "/nodes/3/children/0"},
    {"same child twice",
     [](GlbBuilder& b) {
       b.root["nodes"][0]["children"] = {1, 1};
     },
     "gltf.two_parents", "/nodes/0/children/1"},
    // Indices.
    {"child", [](GlbBuilder& b) { b.root["nodes"][0]["children"] = {99}; }, "gltf.bad_index", "/nodes/0/children/0"},
    {"negative child", [](GlbBuilder& b) { b.root["nodes"][0]["children"] = {-1}; }, "gltf.bad_index",
     "/nodes/0/children/0"},
    {"scene root", [](GlbBuilder& b) { b.root["scenes"][0]["nodes"] = {4}; }, "gltf.bad_index", "/scenes/0/nodes/0"},
    {"scene", [](GlbBuilder& b) { b.root["scene"] = 1; }, "gltf.bad_index", "/scene"},
    {"joint",
     [](GlbBuilder& b) {
       b.root["skins"][0]["joints"] = {0, 1, 4};
     },
     "gltf.bad_index", "/skins/0/joints/2"},
    {"joint as text", [](GlbBuilder& b) { b.root["skins"][0]["joints"] = {"0"}; }, "gltf.wrong_type",
     "/skins/0/joints/0"},
    {"joint 1.5", [](GlbBuilder& b) { b.root["skins"][0]["joints"] = {1.5}; }, "gltf.bad_index", "/skins/0/joints/0"},
    {"skeleton", [](GlbBuilder& b) { b.root["skins"][0]["skeleton"] = -2; }, "gltf.bad_index", "/skins/0/skeleton"},
    {"mesh", [](GlbBuilder& b) { b.root["nodes"][3]["mesh"] = 1; }, "gltf.bad_index", "/nodes/3/mesh"},
    {"skin", [](GlbBuilder& b) { b.root["nodes"][3]["skin"] = 7; }, "gltf.bad_index", "/nodes/3/skin"},
    {"channel node", [](GlbBuilder& b) { b.root["animations"][0]["channels"][0]["target"]["node"] = 4; },
     "gltf.bad_index", "/animations/0/channels/0/target/node"},
    {"sampler", [](GlbBuilder& b) { b.root["animations"][0]["channels"][0]["sampler"] = 1; }, "gltf.bad_index",
     "/animations/0/channels/0/sampler"},
    {"sampler input", [](GlbBuilder& b) { b.root["animations"][0]["samplers"][0]["input"] = 5; }, "gltf.bad_index",
     "/animations/0/samplers/0/input"},
    {"buffer view", [](GlbBuilder& b) { b.root["accessors"][1]["bufferView"] = 5; }, "gltf.bad_index",
     "/accessors/1/bufferView"},
    {"buffer", [](GlbBuilder& b) { b.root["bufferViews"][0]["buffer"] = 99; }, "gltf.bad_index",
     "/bufferViews/0/buffer"},
    // Lists and values of another type, which tinygltf drops silently.
    {"nodes are an object", [](GlbBuilder& b) { b.root["nodes"] = Json::object(); }, "gltf.bad_index",
     "/scenes/0/nodes/0"},
    {"node is a number", [](GlbBuilder& b) { b.root["nodes"][1] = 5; }, "gltf.wrong_type", "/nodes/1"},
    {"translation of one", [](GlbBuilder& b) { b.root["nodes"][1]["translation"] = {1}; }, "gltf.out_of_range",
     "/nodes/1/translation"},
    {"translation of texts",
     [](GlbBuilder& b) {
       b.root["nodes"][1]["translation"] = {"1", "2", "3"};
     },
     "gltf.wrong_type", "/nodes/1/translation/0"},
    {"translation that overflows when squared",
     [](GlbBuilder& b) {
       b.root["nodes"][1]["translation"] = {0, 1e200, 0};
     },
     "gltf.out_of_range", "/nodes/1"},
    {"matrix that overflows when squared",
     [](GlbBuilder& b) { b.root["nodes"][3]["matrix"] = {1e200, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "gltf.out_of_range", "/nodes/3"},
    {"matrix of nine", [](GlbBuilder& b) { b.root["nodes"][3]["matrix"] = Json(std::vector<double>(9, 1.0)); },
     "gltf.out_of_range", "/nodes/3/matrix"},
    {"no channels", [](GlbBuilder& b) { b.root["animations"][0].erase("channels"); }, "gltf.missing", "/animations/0"},
    {"no samplers", [](GlbBuilder& b) { b.root["animations"][0].erase("samplers"); }, "gltf.missing", "/animations/0"},
    {"no asset", [](GlbBuilder& b) { b.root.erase("asset"); }, "gltf.missing", ""},
    {"no joints", [](GlbBuilder& b) { b.root["skins"][0]["joints"] = Json::array(); }, "gltf.out_of_range",
     "/skins/0/joints"},
    {"joint twice",
     [](GlbBuilder& b) {
       b.root["skins"][0]["joints"] = {0, 1, 1};
     },
     "gltf.bad_skin", "/skins/0/joints/2"},
    {"interpolation", [](GlbBuilder& b) { b.root["animations"][0]["samplers"][0]["interpolation"] = "FOO"; },
     "gltf.unsupported", "/animations/0/samplers/0/interpolation"},
    {"path", [](GlbBuilder& b) { b.root["animations"][0]["channels"][0]["target"]["path"] = "foo"; },
     "gltf.unsupported", "/animations/0/channels/0/target/path"},
    {"same target twice",
     [](GlbBuilder& b) { b.root["animations"][0]["channels"].push_back(b.root["animations"][0]["channels"][0]); },
     "gltf.duplicate_channel", "/animations/0/channels/1/target"},
    // Bounds.
    {"count 4e9", [](GlbBuilder& b) { b.root["accessors"][0]["count"] = 4'000'000'000; }, "gltf.truncated",
     "/accessors/0/count"},
    {"count 2^62", [](GlbBuilder& b) { b.root["accessors"][0]["count"] = std::int64_t{1} << 62; }, "gltf.out_of_range",
     "/accessors/0/count"},
    {"count negative", [](GlbBuilder& b) { b.root["accessors"][1]["count"] = -1; }, "gltf.out_of_range",
     "/accessors/1/count"},
    {"accessor offset 2^40", [](GlbBuilder& b) { b.root["accessors"][1]["byteOffset"] = std::int64_t{1} << 40; },
     "gltf.truncated", "/accessors/1/count"},
    {"view length 2^40", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteLength"] = std::int64_t{1} << 40; },
     "gltf.truncated", "/bufferViews/1"},
    {"view offset 2^63", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteOffset"] = std::uint64_t{1} << 63; },
     "gltf.out_of_range", "/bufferViews/1/byteOffset"},
    {"view length 1e300", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteLength"] = 1e300; }, "gltf.out_of_range",
     "/bufferViews/1/byteLength"},
    {"one key too many",
     [](GlbBuilder& b) {
       b.root["accessors"][1]["count"] = 3;
       b.root["accessors"][2]["count"] = 3;
     },
     "gltf.truncated", "/accessors/1/count"},
    {"stride 3", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteStride"] = 3; }, "gltf.out_of_range",
     "/bufferViews/1/byteStride"},
    {"stride 6", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteStride"] = 6; }, "gltf.out_of_range",
     "/bufferViews/1/byteStride"},
    {"stride negative", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteStride"] = -4; }, "gltf.out_of_range",
     "/bufferViews/1/byteStride"},
    {"stride below the element", [](GlbBuilder& b) { b.root["bufferViews"][2]["byteStride"] = 8; }, "gltf.bad_accessor",
     "/accessors/2"},
    {"not aligned", [](GlbBuilder& b) { b.root["bufferViews"][1]["byteOffset"] = 2; }, "gltf.bad_accessor",
     "/accessors/1"},
    {"component type 5124", [](GlbBuilder& b) { b.root["accessors"][1]["componentType"] = 5124; }, "gltf.bad_accessor",
     "/accessors/1/componentType"},
    {"component type 1", [](GlbBuilder& b) { b.root["accessors"][1]["componentType"] = 1; }, "gltf.out_of_range",
     "/accessors/1/componentType"},
    {"rotations as VEC3", [](GlbBuilder& b) { b.root["accessors"][2]["type"] = "VEC3"; }, "gltf.bad_accessor",
     "/accessors/2/type"},
    {"an unknown type", [](GlbBuilder& b) { b.root["accessors"][2]["type"] = "VEC9"; }, "gltf.unreadable", ""},
    {"more values than keys", [](GlbBuilder& b) { b.root["accessors"][1]["count"] = 1; }, "gltf.bad_accessor",
     "/accessors/2/count"},
    {"cubic without tangents",
     [](GlbBuilder& b) { b.root["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; },
     "gltf.bad_accessor", "/accessors/2/count"},
    {"bind matrices too few", [](GlbBuilder& b) { b.root["accessors"][0]["count"] = 2; }, "gltf.bad_skin",
     "/skins/0/inverseBindMatrices"},
    {"sparse of 4e9",
     [](GlbBuilder& b) {
       b.root["accessors"][1]["sparse"] = {{"count", 4'000'000'000},
                                           {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                           {"values", {{"bufferView", 0}}}};
     },
     "gltf.out_of_range", "/accessors/1/sparse/count"},
    {"sparse beyond its view",
     [](GlbBuilder& b) {
       b.root["accessors"][1]["sparse"] = {{"count", 1'000'000'000},
                                           {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                           {"values", {{"bufferView", 0}}}};
     },
     "gltf.truncated", "/accessors/1/sparse/indices/count"},
    // Values.
    {"NaN time", [](GlbBuilder& b) { set_float(b, 1, 1, kNan); }, "gltf.not_finite", "/accessors/1"},
    {"infinite time", [](GlbBuilder& b) { set_float(b, 1, 1, kInfinity); }, "gltf.not_finite", "/accessors/1"},
    {"falling times", [](GlbBuilder& b) { set_float(b, 3, 2, 0.3F); }, "gltf.bad_times", "/accessors/3"},
    {"NaN rotation", [](GlbBuilder& b) { set_float(b, 2, 3, kNan); }, "gltf.not_finite", "/accessors/2"},
    {"zero rotation", [](GlbBuilder& b) { set_float(b, 2, 3, 0.0F); }, "gltf.not_unit", "/accessors/2"},
    {"rotation of length 1.02", [](GlbBuilder& b) { set_float(b, 2, 3, 1.02F); }, "gltf.not_unit", "/accessors/2"},
    {"infinite place", [](GlbBuilder& b) { set_float(b, 4, 8, -kInfinity); }, "gltf.not_finite", "/accessors/4"},
    {"NaN bind matrix", [](GlbBuilder& b) { set_float(b, 0, 17, kNan); }, "gltf.not_finite", "/accessors/0"},
    {"zero node rotation",
     [](GlbBuilder& b) {
       b.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "gltf.not_unit", "/nodes/0/rotation"},
    {"matrix and translation",
     [](GlbBuilder& b) { b.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "gltf.bad_node", "/nodes/0"},
    {"sheared matrix",
     [](GlbBuilder& b) { b.root["nodes"][3]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "gltf.bad_node", "/nodes/3/matrix"},
    {"projecting matrix",
     [](GlbBuilder& b) { b.root["nodes"][3]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "gltf.bad_node", "/nodes/3/matrix"},
    // Files that exhaust memory, stack or patience.
    {"too many nodes",
     [](GlbBuilder& b) {
       b.root["nodes"] = Json::array_t(static_cast<std::size_t>(kMaxGltfNodes) + 1, Json::object());
     },
     "gltf.too_large", "/nodes"},
    {"a name of 10 MB", [](GlbBuilder& b) { b.root["nodes"][0]["name"] = std::string(10'000'000, 'x'); },
     "gltf.too_large", "/nodes/0/name"},
    {"a huge accessor shared by many channels",
     [](GlbBuilder& b) {
       b.root["accessors"].push_back({{"componentType", 5126}, {"count", 40'000'000}, {"type", "VEC3"}});
       b.root["animations"][1]["samplers"][0]["input"] = 3;
       b.root["accessors"][3] = {{"componentType", 5126},
                                 {"count", 40'000'000},
                                 {"type", "SCALAR"},
                                 {"sparse",
                                  {{"count", 1},
                                   {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                   {"values", {{"bufferView", 0}}}}}};
       b.root["animations"][1]["samplers"][0]["output"] = 5;
     },
     "gltf.too_large", "/accessors/3/count"},
    // Features that the file requires and the reader does not have.
    {"version 1.0", [](GlbBuilder& b) { b.root["asset"]["version"] = "1.0"; }, "gltf.unsupported", "/asset/version"},
    {"version 2.0x", [](GlbBuilder& b) { b.root["asset"]["version"] = "2.0x"; }, "gltf.unsupported", "/asset/version"},
    {"least version 2.1", [](GlbBuilder& b) { b.root["asset"]["minVersion"] = "2.1"; }, "gltf.unsupported",
     "/asset/minVersion"},
    {"an unknown extension",
     [](GlbBuilder& b) {
       b.root["extensionsRequired"] = {"KHR_texture_transform", "EXT_made_up"};
     },
     "gltf.unsupported", "/extensionsRequired/1"},
};

TEST(HostileGltf, IsRefusedByNameWithAPointer) {
  for (const Hostile& hostile : kHostile) {
    GlbBuilder b = small_arm();
    hostile.change(b);
    const auto result = parse_glb(b.glb());
    ASSERT_FALSE(result.ok()) << hostile.name;
    EXPECT_EQ(result.issue().code, hostile.code) << hostile.name << ": " << to_line(result.issue());
    EXPECT_EQ(result.issue().pointer, hostile.pointer) << hostile.name << ": " << to_line(result.issue());
    EXPECT_LT(result.issue().text.size(), 200U) << hostile.name;
  }
}

std::string code_of_json(const std::string& json) {
  const auto result = parse_glb(pack_glb(json, {}));
  return result.ok() ? "ok" : result.issue().code;
}

TEST(HostileGltf, BrokenJsonIsRefused) {
  EXPECT_EQ(code_of_json("{"), "gltf.bad_json");
  EXPECT_EQ(code_of_json("{\"asset\":{\"version\":\"2.0\"}} x"), "gltf.bad_json");
  EXPECT_EQ(code_of_json("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"translation\":[NaN,0,0]}]}"), "gltf.bad_json");
  EXPECT_EQ(code_of_json("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"name\":\"\xff\"}]}"), "gltf.bad_json");
  EXPECT_EQ(code_of_json("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"scale\":[1e999,1,1]}]}"), "gltf.not_finite");
}

TEST(HostileGltf, DeepExtrasDoNotReachTheParser) {
  const std::string deep(100'000, '[');
  EXPECT_EQ(code_of_json("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep + std::string(100'000, ']') + "}"),
            "gltf.too_deep");
}

TEST(HostileGltf, DeepNodesNeedNoStack) {
  GlbBuilder b;
  const int count = static_cast<int>(kMaxGltfNodes);
  for (int i = 0; i < count; ++i)
    b.root["nodes"].push_back(i + 1 < count ? Json{{"children", {i + 1}}} : Json::object());
  const auto result = parse_glb(b.glb());
  ASSERT_TRUE(result.ok()) << to_line(result.issue());
  EXPECT_EQ(result->order.back(), count - 1);
}

TEST(HostileGltf, BuffersOfLengthZeroAndBuffersWithoutBytesAreRefused) {
  GlbBuilder b = small_arm();
  Json root = b.root;
  root["buffers"] = {{{"byteLength", 0}}};  // tinygltf aborts on this one
  auto result = parse_glb(pack_glb(root.dump(), b.bin));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.issue().code, "gltf.out_of_range");
  root["buffers"] = {{{"byteLength", b.bin.size() + 1}}};
  result = parse_glb(pack_glb(root.dump(), b.bin));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.issue().code, "gltf.truncated");
  root["buffers"] = {{{"byteLength", b.bin.size()}}};
  result = parse_glb(pack_glb(root.dump(), {}));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.issue().code, "gltf.truncated");
}

TEST(HostileGltf, ImagesAndMeshesAreNeverLookedAt) {
  GlbBuilder b = small_arm();
  b.root["images"] = {
      {{"uri", "../../../etc/hostname"}}, {{"uri", "data:image/png;base64,AAAA"}}, {{"bufferView", 99}}};
  b.root["textures"] = "no list";
  b.root["meshes"][0]["primitives"] = {{{"attributes", {{"POSITION", 99}}}, {"indices", -5}}};
  EXPECT_EQ(parse_glb(b.glb())->nodes, parse_glb(small_arm().glb())->nodes);
}

TEST(HostileGltf, NoBufferMayBeAFileWhereThereIsNoFolder) {
  GlbBuilder b = small_arm();
  b.root["buffers"] = {{{"byteLength", 4}, {"uri", "x.bin"}}};
  const auto result = parse_glb(pack_glb(b.root.dump(), b.bin));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.issue().code, "gltf.bad_uri");
}

// After any change, the result is an asset or an issue. Run under ASan and UBSan in the dev preset.
RC_GTEST_PROP(HostileGltfProperty, ChangedBytesNeverCrash, ()) {
  ByteList glb = small_arm().glb();
  const auto changes = *rc::gen::container<std::vector<std::pair<std::uint16_t, std::uint8_t>>>(
      rc::gen::arbitrary<std::pair<std::uint16_t, std::uint8_t>>());
  for (const auto& [place, value] : changes) glb[12 + place % (glb.size() - 12)] = static_cast<std::byte>(value);
  const auto result = parse_glb(glb);
  if (!result.ok()) RC_ASSERT(result.issue().code.starts_with("gltf."));
}

RC_GTEST_PROP(HostileGltfProperty, ChangedNumbersInTheJsonNeverCrash, ()) {
  std::string json = small_arm().document().dump();
  std::vector<std::size_t> digits;
  for (std::size_t i = 0; i < json.size(); ++i)
    if (json[i] >= '0' && json[i] <= '9') digits.push_back(i);
  const auto changes = *rc::gen::container<std::vector<std::pair<std::uint16_t, char>>>(
      rc::gen::pair(rc::gen::arbitrary<std::uint16_t>(), rc::gen::element('0', '1', '7', '9', '-', '.', 'e')));
  for (const auto& [place, digit] : changes) json[digits[place % digits.size()]] = digit;
  const auto result = parse_glb(pack_glb(json, small_arm().bin));
  if (!result.ok()) RC_ASSERT(result.issue().code.starts_with("gltf."));
}

}  // namespace
}  // namespace contort
