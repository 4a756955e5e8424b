// glTF with compressed or quantised numbers, and channels that name their target by a pointer.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>

#include "model/asset/sample.h"
#include "tests/import/rigged_model.h"

namespace contort {
namespace {

using fixtures::ByteList;
using fixtures::GlbBuilder;
using fixtures::Json;
using fixtures::rigged;
using fixtures::small_arm;
using fixtures::worm;

const unsigned char* bytes_at(const GlbBuilder& b, std::size_t offset) {
  return reinterpret_cast<const unsigned char*>(b.bin.data()) + offset;
}

// Bytes at the end of the buffer; where they begin.
std::size_t append_bytes(GlbBuilder& b, const unsigned char* first, std::size_t size) {
  while (b.bin.size() % 4 != 0) b.bin.push_back(std::byte{0});
  const std::size_t offset = b.bin.size();
  const auto* from = reinterpret_cast<const std::byte*>(first);
  b.bin.insert(b.bin.end(), from, from + size);
  return offset;
}

Json& packed_view(GlbBuilder& b, std::size_t view) {
  return b.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

// Packs a view as elements of four bytes, and leaves zeros at its place as a fallback.
void pack_view(GlbBuilder& b, std::size_t view, std::size_t stride = 4) {
  const std::size_t offset = b.root["bufferViews"][view]["byteOffset"];
  const std::size_t size = b.root["bufferViews"][view]["byteLength"];
  const std::size_t count = size / stride;
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(count, stride));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), bytes_at(b, offset), count, stride));
  std::fill_n(b.bin.begin() + static_cast<std::ptrdiff_t>(offset), size, std::byte{0});
  const std::size_t at = append_bytes(b, packed.data(), packed.size());
  packed_view(b, view) = {{"buffer", 0},         {"byteOffset", at}, {"byteLength", packed.size()},
                          {"byteStride", stride}, {"count", count},   {"mode", "ATTRIBUTES"}};
}

GlbBuilder packed_worm() {
  GlbBuilder b = rigged(worm(2));
  b.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  for (std::size_t view = 0, count = b.root["bufferViews"].size(); view < count; ++view)
    if (b.root["bufferViews"][view]["byteLength"].get<std::size_t>() % 4 == 0) pack_view(b, view);
  return b;
}

std::string skinned_code(const GlbBuilder& b) {
  const Result<SkinnedAsset> read = parse_skinned_glb(b.glb());
  return read.ok() ? "ok" : read.issue().code;
}

TEST(Meshopt, PackedViewsAreReadLikePlainOnes) {
  const Result<SkinnedAsset> plain = parse_skinned_glb(rigged(worm(2)).glb());
  const Result<SkinnedAsset> packed = parse_skinned_glb(packed_worm().glb());
  ASSERT_TRUE(packed.ok()) << to_line(packed.issue());
  EXPECT_TRUE(*packed == *plain);
}

TEST(Meshopt, PackedAnimationsAreReadWithTheirFilter) {
  GlbBuilder b = small_arm();
  const float half = 0.70710678F;
  const float turns[] = {0, 0, 0, 1, half, 0, 0, half};
  std::vector<std::int16_t> filtered(8);
  meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, turns);
  const int accessor = b.add(filtered, 5122, "VEC4", 4, true);
  pack_view(b, b.root["accessors"][static_cast<std::size_t>(accessor)]["bufferView"], 8);
  packed_view(b, b.root["bufferViews"].size() - 1)["filter"] = "QUATERNION";
  b.root["animations"][0]["samplers"][0]["output"] = accessor;
  const Result<Asset> asset = parse_glb(b.glb());
  ASSERT_TRUE(asset.ok()) << to_line(asset.issue());
  const Quat turned = sample_rotation(asset->clips[0].channels[0], 1.0);
  EXPECT_LT(rotation_angle(glm::conjugate(turned) * axis_angle(Vec3(1, 0, 0), 0.5 * kPi)), 1e-3);
}

TEST(Meshopt, EveryPrefixIsACleanAnswer) {
  const GlbBuilder whole = packed_worm();
  for (std::size_t view = 0; view < whole.root["bufferViews"].size(); ++view) {
    if (!whole.root["bufferViews"][view].contains("extensions")) continue;
    GlbBuilder cut = whole;
    const std::size_t size = packed_view(cut, view)["byteLength"];
    for (std::size_t length = 0; length < size; ++length) {
      packed_view(cut, view)["byteLength"] = length;
      EXPECT_EQ(skinned_code(cut), "gltf.bad_compression") << view << " " << length;
    }
  }
}

TEST(Meshopt, LiesAreRefusedByName) {
  const auto code_with = [](const char* key, const Json& value) {
    GlbBuilder b = packed_worm();
    packed_view(b, 0)[key] = value;
    return skinned_code(b);
  };
  EXPECT_EQ(code_with("buffer", 7), "gltf.bad_index");
  EXPECT_EQ(code_with("byteOffset", 1'000'000), "gltf.truncated");
  EXPECT_EQ(code_with("byteLength", 1'000'000), "gltf.truncated");
  EXPECT_EQ(code_with("count", 1'000'000'000), "gltf.bad_compression");
  EXPECT_EQ(code_with("count", -1), "gltf.wrong_type");
  EXPECT_EQ(code_with("byteStride", 3), "gltf.bad_compression");
  EXPECT_EQ(code_with("byteStride", 0), "gltf.bad_compression");
  EXPECT_EQ(code_with("mode", "TRIANGLES"), "gltf.bad_compression");
  EXPECT_EQ(code_with("mode", "OTHER"), "gltf.bad_compression");
  EXPECT_EQ(code_with("filter", "QUATERNION"), "gltf.bad_compression");
  GlbBuilder missing = packed_worm();
  packed_view(missing, 0).erase("count");
  EXPECT_EQ(skinned_code(missing), "gltf.missing");
}

// ---- Draco

std::vector<Vec3> corners_of(const SkinnedMesh& mesh) {
  std::vector<Vec3> corners;
  for (const int index : mesh.indices) corners.push_back(mesh.vertices[static_cast<std::size_t>(index)].position);
  std::ranges::sort(corners, [](const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  });
  return corners;
}

// The mesh of a model in Draco's form, with the number of its vertices there.
std::vector<unsigned char> draco_of(const SkinnedMesh& mesh, std::size_t& points) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(mesh.indices.size() / 3));
  const int place = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int joints = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  const int weights = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
  for (std::size_t face = 0; face < mesh.indices.size() / 3; ++face) {
    float p[3][3];
    std::uint8_t j[3][4];
    float w[3][4];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const SkinnedVertex& v = mesh.vertices[static_cast<std::size_t>(mesh.indices[3 * face + corner])];
      for (int i = 0; i < 3; ++i) p[corner][i] = static_cast<float>(v.position[i]);
      for (std::size_t i = 0; i < 4; ++i) j[corner][i] = static_cast<std::uint8_t>(v.joints[i]);
      for (std::size_t i = 0; i < 4; ++i) w[corner][i] = static_cast<float>(v.weights[i]);
    }
    const draco::FaceIndex index(static_cast<std::uint32_t>(face));
    builder.SetAttributeValuesForFace(place, index, p[0], p[1], p[2]);
    builder.SetAttributeValuesForFace(joints, index, j[0], j[1], j[2]);
    builder.SetAttributeValuesForFace(weights, index, w[0], w[1], w[2]);
  }
  draco::Encoder encoder;
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer out;
  const bool was_encoded = encoder.EncodeMeshToBuffer(*builder.Finalize(), &out).ok();
  points = encoder.num_encoded_points();
  const auto* first = reinterpret_cast<const unsigned char*>(out.data());
  return was_encoded ? std::vector<unsigned char>(first, first + out.size()) : std::vector<unsigned char>();
}

GlbBuilder draco_worm(std::vector<unsigned char> packed, std::size_t points) {
  GlbBuilder b = rigged(worm(2));
  b.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const std::size_t at = append_bytes(b, packed.data(), packed.size());
  b.root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", packed.size()}});
  Json& primitive = b.root["meshes"][0]["primitives"][0];
  for (const auto& [name, accessor] : primitive["attributes"].items()) {
    Json& plain = b.root["accessors"][accessor.get<std::size_t>()];
    plain.erase("bufferView");
    plain["count"] = points;
  }
  b.root["accessors"][primitive["indices"].get<std::size_t>()].erase("bufferView");
  primitive["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", b.root["bufferViews"].size() - 1},
      {"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}, {"WEIGHTS_0", 2}}}};
  return b;
}

struct DracoModel {
  SkinnedMesh plain = parse_skinned_glb(rigged(worm(2)).glb())->meshes[0];
  std::size_t points = 0;
  std::vector<unsigned char> packed = draco_of(plain, points);
};

TEST(Draco, AMeshIsReadLikeThePlainOne) {
  const DracoModel model;
  const Result<SkinnedAsset> read = parse_skinned_glb(draco_worm(model.packed, model.points).glb());
  ASSERT_TRUE(read.ok()) << to_line(read.issue());
  ASSERT_EQ(read->meshes.size(), 1U);
  const std::vector<Vec3> corners = corners_of(read->meshes[0]), expected = corners_of(model.plain);
  ASSERT_EQ(corners.size(), expected.size());
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_LT(glm::length(corners[i] - expected[i]), 1e-3) << i;
  const auto on_second = [](const SkinnedMesh& m) {
    return std::ranges::count_if(m.indices,
                                 [&](int i) { return m.vertices[static_cast<std::size_t>(i)].joints[0] == 1; });
  };
  EXPECT_EQ(on_second(read->meshes[0]), on_second(model.plain));
}

TEST(Draco, HindersNobodyWhoReadsNoMeshes) {
  const DracoModel model;
  EXPECT_TRUE(parse_glb(draco_worm({1, 2, 3}, model.points).glb()).ok());
}

TEST(Draco, EveryPrefixIsACleanAnswer) {
  const DracoModel model;
  for (std::size_t size = 1; size < model.packed.size(); ++size) {
    const auto end = model.packed.begin() + static_cast<std::ptrdiff_t>(size);
    EXPECT_EQ(skinned_code(draco_worm({model.packed.begin(), end}, model.points)), "gltf.bad_compression") << size;
  }
}

TEST(Draco, AHeaderCannotAskForMemoryThatTheBytesDoNotEarn) {
  DracoModel model;
  for (std::size_t i = 12; i < 16; ++i) model.packed[i] = 0xFF;
  EXPECT_EQ(skinned_code(draco_worm(model.packed, model.points)), "gltf.bad_compression");
}

TEST(Draco, EveryChangedByteIsACleanAnswer) {
  const DracoModel model;
  for (std::size_t i = 0; i < model.packed.size(); ++i)
    for (const unsigned flip : {0x01U, 0x80U, 0xFFU}) {
      std::vector<unsigned char> changed = model.packed;
      changed[i] = static_cast<unsigned char>(changed[i] ^ flip);
      EXPECT_FALSE(skinned_code(draco_worm(changed, model.points)).empty());
    }
}

TEST(Draco, OtherNumbersOfVerticesAreRefused) {
  const DracoModel model;
  EXPECT_EQ(skinned_code(draco_worm(model.packed, model.points + 1)), "gltf.bad_compression");
}

// ---- KHR_mesh_quantization

TEST(Quantization, PositionsMayBeWholeNumbers) {
  GlbBuilder b = rigged(worm(2));
  b.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  std::vector<std::int16_t> places(48);
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<std::int16_t>(100 * i);
  b.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = b.add(places, 5122, "VEC3", 3);
  const Result<SkinnedAsset> read = parse_skinned_glb(b.glb());
  ASSERT_TRUE(read.ok()) << to_line(read.issue());
  EXPECT_EQ(read->meshes[0].vertices[1].position, Vec3(300, 400, 500));
}

// ---- KHR_animation_pointer

TEST(AnimationPointer, PropertiesOfNodesAreChannels) {
  GlbBuilder b = small_arm();
  const Result<Asset> plain = parse_glb(b.glb());
  b.root["extensionsRequired"] = {"KHR_animation_pointer"};
  Json& target = b.root["animations"][0]["channels"][0]["target"];
  target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/rotation"}}}}}};
  const Result<Asset> asset = parse_glb(b.glb());
  ASSERT_TRUE(asset.ok()) << to_line(asset.issue());
  EXPECT_EQ(asset->clips, plain->clips);
  EXPECT_TRUE(asset->remarks.empty());
}

TEST(AnimationPointer, OtherTargetsAreCountedAndLeftOut) {
  GlbBuilder b = small_arm();
  for (const char* pointer : {"/materials/0/alphaCutoff", "/nodes/x/rotation", "/nodes/0/weird", "/nodes/0", ""}) {
    Json& target = b.root["animations"][0]["channels"][0]["target"];
    target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
    const Result<Asset> asset = parse_glb(b.glb());
    ASSERT_TRUE(asset.ok()) << pointer << ": " << to_line(asset.issue());
    EXPECT_TRUE(asset->clips[0].channels.empty()) << pointer;
    ASSERT_EQ(asset->remarks.size(), 1U) << pointer;
    EXPECT_EQ(asset->remarks[0].code, "gltf.pointers");
  }
}

TEST(AnimationPointer, BadPointersAreRefused) {
  GlbBuilder b = small_arm();
  Json& target = b.root["animations"][0]["channels"][0]["target"];
  target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", 7}}}}}};
  EXPECT_EQ(parse_glb(b.glb()).issue().code, "gltf.bad_pointer");
  target["extensions"]["KHR_animation_pointer"]["pointer"] = "/nodes/99/rotation";
  EXPECT_EQ(parse_glb(b.glb()).issue().code, "gltf.bad_index");
}

}  // namespace
}  // namespace contort
