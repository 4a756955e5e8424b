#include "formats/gltf/read.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "formats/gltf/from_model.h"
#include "model/asset/labels.h"
#include "tests/corpus/temp_folder.h"
#include "tests/gltf/glb_builder.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::GlbBuilder;
using fixtures::Json;
using fixtures::pack_glb;
using fixtures::small_arm;

Asset read(const GlbBuilder& builder) {
  const auto result = parse_glb(builder.glb());
  EXPECT_TRUE(result.ok()) << to_line(result.issue());
  return result.ok() ? *result : Asset{};
}

// ---- nodes

TEST(ReadGltf, GivesNodesAsTheFileHasThem) {
  const Asset asset = read(small_arm());
  ASSERT_EQ(asset.nodes.size(), 4U);
  EXPECT_EQ(asset.nodes[1].name, "lower");
  EXPECT_EQ(asset.nodes[1].label, "lower");
  EXPECT_EQ(asset.nodes[1].parent, 0);
  EXPECT_EQ(asset.nodes[1].rest.translation, Vec3(0, -0.5, 0));
  EXPECT_EQ(asset.nodes[2].rest.scale, Vec3(1, 2, 1));
  EXPECT_EQ(asset.nodes[3].parent, -1);
  EXPECT_EQ(asset.nodes[3].rest, Trs{});
}

TEST(ReadGltf, OrdersParentsBeforeChildrenWhateverTheFileDoes) {
  GlbBuilder b;
  b.root["nodes"] = {Json::object(), {{"children", {0, 3}}}, {{"children", {1}}}, Json::object()};
  const Asset asset = read(b);
  EXPECT_EQ(asset.order, (std::vector<int>{2, 1, 0, 3}));
}

TEST(ReadGltf, MakesLabelsForUnnamedAndDuplicateNodes) {
  GlbBuilder b;
  b.root["nodes"] = {{{"name", "hand"}}, Json::object(), {{"name", "hand"}}, {{"name", "hand#0"}}, {{"name", ""}}};
  const Asset asset = read(b);
  std::vector<std::string> labels;
  for (const AssetNode& node : asset.nodes) labels.push_back(node.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"hand#0#0", "#1", "hand#2", "hand#0", "#4"}));
  EXPECT_EQ(asset.nodes[0].name, "hand");
}

RC_GTEST_PROP(ReadGltfProperty, LabelsAreUniqueAndKeepUniqueNames, ()) {
  const auto names = *rc::gen::container<std::vector<std::string>>(
      rc::gen::element<std::string>("", "a", "b", "a#0", "a#1", "#0", "#1", "#1#1", "c"));
  const std::vector<std::string> labels = unique_labels(names);
  RC_ASSERT(labels.size() == names.size());
  RC_ASSERT(std::set<std::string>(labels.begin(), labels.end()).size() == labels.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    RC_ASSERT(!labels[i].empty() && labels[i].starts_with(names[i]));
    if (!names[i].empty() && std::count(names.begin(), names.end(), names[i]) == 1) RC_ASSERT(labels[i] == names[i]);
  }
}

// ---- matrices

std::vector<double> compose(const Trs& trs) {
  std::vector<double> m(16, 0.0);
  for (int i = 0; i < 3; ++i) {
    Vec3 axis(0.0);
    axis[i] = trs.scale[i];
    const Vec3 column = trs.rotation * axis;
    for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(4 * i + j)] = column[j];
    m[static_cast<std::size_t>(12 + i)] = trs.translation[i];
  }
  m[15] = 1.0;
  return m;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::fabs(a[i] - b[i]));
  return out;
}

double coordinate() { return *rc::gen::inRange(-1000, 1000) / 250.0; }

// Signs of two scales and half a turn are one and the same matrix, so matrices are compared. Measured worst: 7e-15.
RC_GTEST_PROP(ReadGltfProperty, AMatrixIsTheProductOfItsParts, ()) {
  Trs trs;
  trs.translation = {coordinate(), coordinate(), coordinate()};
  trs.rotation = from_rotation_vector(Vec3(coordinate(), coordinate(), coordinate()));
  trs.scale = {coordinate(), coordinate(), coordinate()};
  Trs out;
  RC_ASSERT(decompose(compose(trs), out));
  RC_ASSERT(largest_difference(compose(out), compose(trs)) < 1e-13);
  RC_ASSERT(std::fabs(glm::length(out.rotation) - 1.0) < 1e-14);
}

TEST(ReadGltf, DecomposesMirroringMatrices) {
  GlbBuilder b;
  b.root["nodes"] = {{{"matrix", {1, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}};
  const Trs rest = read(b).nodes[0].rest;
  EXPECT_EQ(rest.translation, Vec3(5, 6, 7));
  EXPECT_DOUBLE_EQ(rest.scale.x * rest.scale.y * rest.scale.z, -2.0);
  EXPECT_LT(largest_difference(compose(rest), {1, 0, 0, 0, 0, -2, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}), 1e-15);
}

TEST(ReadGltf, KeepsMatricesOfScaleZeroFinite) {
  for (const char* matrix : {"[0,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", "[0,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1]",
                             "[0,0,0,0,0,0,0,0,0,0,0,0,1,2,3,1]"}) {
    GlbBuilder b;
    b.root["nodes"] = {{{"matrix", Json::parse(matrix)}}};
    const Trs rest = read(b).nodes[0].rest;
    EXPECT_DOUBLE_EQ(glm::length(rest.rotation), 1.0) << matrix;
    EXPECT_EQ(rest.scale.x, 0.0) << matrix;
  }
}

// ---- names

TEST(ReadGltf, AModelAsTextIsReadUnderAnyName) {
  const TempFolder folder;
  spill(folder / "a.glb", "\n {\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"name\": \"arm\"}]}");
  const Result<Asset> asset = read_gltf(folder / "a.glb");
  ASSERT_TRUE(asset.ok()) << to_line(asset.issue());
  EXPECT_EQ(asset->nodes.size(), 1U);
}

// ---- times

// Blender writes keys from before frame 0, and 32-bit floats make close times equal.
TEST(ReadGltf, ReadsKeysBeforeTimeZeroAndAtEqualTimes) {
  GlbBuilder b = small_arm();
  const std::size_t at = b.root["bufferViews"][1]["byteOffset"];
  const float early[] = {-0.5F, -0.5F};
  std::memcpy(b.bin.data() + at, early, sizeof early);
  const Asset asset = read(b);
  EXPECT_EQ(asset.clips[0].first_s, -0.5);
  EXPECT_EQ(asset.clips[0].channels[0].times_s[1], -0.5);
  ASSERT_EQ(asset.remarks.size(), 2U);
  EXPECT_EQ(asset.remarks[0].code, "gltf.negative_times");
  EXPECT_EQ(asset.remarks[1].code, "gltf.equal_times");
}

// ---- skins

TEST(ReadGltf, GivesSkinsAndMarksTheirJoints) {
  const Asset asset = read(small_arm());
  ASSERT_EQ(asset.skins.size(), 1U);
  EXPECT_EQ(asset.skins[0].joints, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(asset.skins[0].skeleton, 0);
  EXPECT_EQ(asset.skins[0].joint_from_mesh[2][3][1], 2.0);  // column 3, row 1
  EXPECT_TRUE(asset.nodes[2].is_joint);
  EXPECT_FALSE(asset.nodes[3].is_joint);
}

TEST(ReadGltf, TakesIdentityWhereASkinHasNoBindMatrices) {
  GlbBuilder b = small_arm();
  b.root["skins"][0].erase("inverseBindMatrices");
  b.root["skins"][0].erase("skeleton");
  const Asset asset = read(b);
  EXPECT_EQ(asset.skins[0].joint_from_mesh, std::vector<Mat4>(3, Mat4(1.0)));
  EXPECT_EQ(asset.skins[0].skeleton, -1);
}

// ---- clips

TEST(ReadGltf, GivesClipsWithTheirKeys) {
  const Asset asset = read(small_arm());
  ASSERT_EQ(asset.clips.size(), 2U);
  EXPECT_EQ(asset.clips[0].label, "wave");
  const AssetChannel& turn = asset.clips[0].channels[0];
  EXPECT_EQ(turn.node, 0);
  EXPECT_EQ(turn.path, ChannelPath::rotation);
  EXPECT_EQ(turn.interpolation, Interpolation::linear);
  EXPECT_EQ(turn.times_s, (std::vector<double>{0.0, 1.0}));
  EXPECT_NEAR(turn.values[4], 0.70710678, 1e-8);
  const AssetChannel& move = asset.clips[1].channels[0];
  EXPECT_EQ(move.interpolation, Interpolation::step);
  EXPECT_EQ(move.values, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 2, 3}));
  EXPECT_EQ(asset.clips[1].first_s, 0.25);
  EXPECT_EQ(asset.clips[1].last_s, 2.0);
}

TEST(ReadGltf, TakesLinearWhereASamplerDoesNotSay) {
  GlbBuilder b = small_arm();
  b.root["animations"][1]["samplers"][0].erase("interpolation");
  EXPECT_EQ(read(b).clips[1].channels[0].interpolation, Interpolation::linear);
}

TEST(ReadGltf, LeavesOutWhatMovesNoNode) {
  GlbBuilder b = small_arm();
  b.root["animations"][0]["channels"][0]["target"]["path"] = "weights";
  b.root["animations"][1]["channels"][0]["target"].erase("node");
  const Asset asset = read(b);
  ASSERT_EQ(asset.clips.size(), 2U);
  EXPECT_TRUE(asset.clips[0].channels.empty());
  EXPECT_TRUE(asset.clips[1].channels.empty());
  EXPECT_EQ(asset.clips[0].last_s, 0.0);
}

TEST(ReadGltf, CountsChannelsAsTheFileDoesAfterOneIsLeftOut) {
  GlbBuilder b = small_arm();
  Json& channels = b.root["animations"][0]["channels"];
  channels.insert(channels.begin(), Json{{"sampler", 0}, {"target", {{"path", "rotation"}}}});
  channels[1]["sampler"] = 9;
  const auto result = parse_glb(b.glb());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.issue().pointer, "/animations/0/channels/1/sampler");
}

TEST(ReadGltf, LeavesOutChannelsWithoutKeys) {
  GlbBuilder b = small_arm();
  b.root["accessors"][1]["count"] = 0;
  b.root["accessors"][2]["count"] = 0;
  const Asset asset = read(b);
  EXPECT_TRUE(asset.clips[0].channels.empty());
  EXPECT_EQ(asset.clips[1].channels.size(), 1U);
}

TEST(ReadGltf, NormalisesRotationsThatAreNearlyUnit) {
  GlbBuilder b = small_arm();
  const float long_w = 1.005F;
  std::memcpy(b.bin.data() + b.root["bufferViews"][2]["byteOffset"].get<std::size_t>() + 12, &long_w, 4);
  EXPECT_EQ(read(b).clips[0].channels[0].values[3], 1.0);
}

// 45 degrees about z in all formats that the standard has for rotations.
TEST(ReadGltf, ReadsRotationsAsNormalisedIntegers) {
  const double z = 0.38268343;
  const double w = 0.92387953;
  const auto scaled = [](double v, double most) { return static_cast<int>(std::lround(v * most)); };
  GlbBuilder b = small_arm();
  const auto row = [&]<class T>(T, double most) {
    return std::vector<T>{0, 0, static_cast<T>(scaled(z, most)), static_cast<T>(scaled(w, most))};
  };
  b.root["animations"] = Json::array();
  const int time = b.add_scalars({0.5F});
  const int outputs[] = {b.add(row(std::int8_t{}, 127), 5120, "VEC4", 4, true),
                         b.add(row(std::uint8_t{}, 255), 5121, "VEC4", 4, true),
                         b.add(row(std::int16_t{}, 32767), 5122, "VEC4", 4, true),
                         b.add(row(std::uint16_t{}, 65535), 5123, "VEC4", 4, true)};
  for (std::size_t i = 0; i < 4; ++i) b.add_channel(i, 0, "rotation", time, outputs[i]);
  const Asset asset = read(b);
  const double tolerance[] = {4e-3, 2e-3, 2e-5, 1e-5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(asset.clips[i].channels[0].values[2], z, tolerance[i]);
    EXPECT_NEAR(asset.clips[i].channels[0].values[3], w, tolerance[i]);
  }
}

TEST(ReadGltf, RefusesIntegersThatAreNotNormalised) {
  GlbBuilder b = small_arm();
  const int output = b.add(std::vector<std::int16_t>{0, 0, 0, 1, 0, 0, 0, 1}, 5122, "VEC4", 4);
  b.root["animations"][0]["samplers"][0]["output"] = output;
  const auto result = parse_glb(b.glb());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.issue().code, "gltf.bad_accessor");
}

TEST(ReadGltf, ReadsSparseAccessors) {
  GlbBuilder b = small_arm();
  const int indices = b.add(std::vector<std::uint16_t>{1}, 5123, "SCALAR", 1);
  const int values = b.add_vec3({7, 8, 9});
  b.root["accessors"][4]["sparse"] = {
      {"count", 1},
      {"indices",
       {{"bufferView", b.root["accessors"][static_cast<std::size_t>(indices)]["bufferView"]}, {"componentType", 5123}}},
      {"values", {{"bufferView", b.root["accessors"][static_cast<std::size_t>(values)]["bufferView"]}}}};
  EXPECT_EQ(read(b).clips[1].channels[0].values, (std::vector<double>{0, 0, 0, 7, 8, 9, 1, 2, 3}));
  b.root["accessors"][4].erase("bufferView");  // all others are zero then
  EXPECT_EQ(read(b).clips[1].channels[0].values, (std::vector<double>{0, 0, 0, 7, 8, 9, 0, 0, 0}));
  const std::uint16_t beyond = 3;
  const std::size_t view = b.root["accessors"][static_cast<std::size_t>(indices)]["bufferView"];
  std::memcpy(b.bin.data() + b.root["bufferViews"][view]["byteOffset"].get<std::size_t>(), &beyond, 2);
  EXPECT_EQ(parse_glb(b.glb()).issue().code, "gltf.bad_index");
}

TEST(ReadGltf, ReadsElementsThatLieApart) {
  GlbBuilder b = small_arm();
  b.root["accessors"][4]["count"] = 2;
  b.root["accessors"][3]["count"] = 2;
  b.root["bufferViews"][4]["byteStride"] = 24;
  EXPECT_EQ(read(b).clips[1].channels[0].values, (std::vector<double>{0, 0, 0, 1, 2, 3}));
}

// Written values are read back bit by bit: nothing between the file and the asset rounds.
RC_GTEST_PROP(ReadGltfProperty, KeysComeBackAsTheyAre, ()) {
  const auto numbers = *rc::gen::suchThat(rc::gen::container<std::vector<int>>(rc::gen::inRange(-100000, 100000)),
                                          [](const auto& v) { return v.size() >= 3; });
  GlbBuilder b;
  b.root["nodes"] = Json::array({Json::object()});
  std::vector<float> times;
  std::vector<float> values;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    times.push_back(static_cast<float>(i) / 7.0F);
    for (std::size_t c = 0; c < 3; ++c) values.push_back(static_cast<float>(numbers[i + c]) / 3.0F);
  }
  b.root["animations"] = Json::array({Json::object()});
  b.add_channel(0, 0, "translation", b.add_scalars(times), b.add_vec3(values));
  const auto result = parse_glb(b.glb());
  RC_ASSERT(result.ok());
  const AssetChannel& channel = result->clips[0].channels[0];
  RC_ASSERT(channel.times_s == std::vector<double>(times.begin(), times.end()));
  RC_ASSERT(channel.values == std::vector<double>(values.begin(), values.end()));
}

TEST(ReadGltf, ReadsTheSmallestFile) {
  const auto result = parse_glb(pack_glb("{\"asset\":{\"version\":\"2.0\"}}", {}));
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(*result, Asset{});
}

}  // namespace
}  // namespace contort
