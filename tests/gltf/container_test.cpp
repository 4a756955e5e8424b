#include "formats/gltf/container.h"

#include <gtest/gtest.h>

#include "formats/gltf/limits.h"
#include "formats/gltf/read.h"
#include "tests/gltf/glb_builder.h"

namespace contort {
namespace {

using fixtures::append_u32;
using fixtures::ByteList;
using fixtures::pack_glb;
using fixtures::small_arm;
using fixtures::to_bytes;

void set_u32(ByteList& bytes, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::byte>(value >> (8 * i));
}

std::string code_of(const ByteList& bytes) {
  const auto split = split_glb(bytes);
  return split.ok() ? "ok" : split.issue().code;
}

ByteList with_chunk(ByteList glb, std::uint32_t type, std::size_t size) {
  append_u32(glb, static_cast<std::uint32_t>(size));
  append_u32(glb, type);
  glb.resize(glb.size() + size);
  set_u32(glb, 8, static_cast<std::uint32_t>(glb.size()));
  return glb;
}

TEST(GlbContainer, GivesTheJsonAndTheBinaryChunk) {
  const ByteList glb = pack_glb("{\"a\":1}", to_bytes("12345678"));
  const auto split = split_glb(glb);
  ASSERT_TRUE(split.ok());
  EXPECT_EQ(split->json, "{\"a\":1} ");
  EXPECT_TRUE(split->has_bin);
  EXPECT_EQ(split->bin.size(), 8U);
}

TEST(GlbContainer, DoesWithoutABinaryChunk) {
  const auto split = split_glb(pack_glb("{}", {}));
  ASSERT_TRUE(split.ok());
  EXPECT_FALSE(split->has_bin);
}

TEST(GlbContainer, EveryPrefixIsACleanError) {
  const ByteList glb = small_arm().glb();
  ASSERT_TRUE(parse_glb(glb).ok());
  for (std::size_t size = 0; size < glb.size(); ++size) {
    const auto result = parse_glb(std::span(glb).first(size));
    ASSERT_FALSE(result.ok()) << size;
    EXPECT_EQ(result.issue().code, "gltf.truncated") << size;
  }
}

TEST(GlbContainer, EveryPrefixWithARepairedLengthIsACleanError) {
  const ByteList glb = small_arm().glb();
  for (std::size_t size = 12; size < glb.size(); ++size) {
    ByteList cut(glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(size));
    set_u32(cut, 8, static_cast<std::uint32_t>(size));
    const auto result = parse_glb(cut);
    ASSERT_FALSE(result.ok()) << size;
    EXPECT_EQ(result.issue().code.substr(0, 5), "gltf.") << size;
  }
}

TEST(GlbContainer, RefusesOtherMagicVersionAndLength) {
  const ByteList good = small_arm().glb();
  ByteList bad = good;
  bad[0] = std::byte{'G'};
  EXPECT_EQ(code_of(bad), "gltf.bad_header");
  bad = good;
  set_u32(bad, 4, 1);
  EXPECT_EQ(code_of(bad), "gltf.unsupported");
  bad = good;
  set_u32(bad, 8, static_cast<std::uint32_t>(good.size() + 4));
  EXPECT_EQ(code_of(bad), "gltf.truncated");
  bad = good;
  set_u32(bad, 8, 8);
  EXPECT_EQ(code_of(bad), "gltf.bad_header");
}

// Archives and web servers pad files.
TEST(GlbContainer, BytesAfterTheEndAreRemarkedAndNotRead) {
  const ByteList good = small_arm().glb();
  for (const std::size_t more : {std::size_t{1}, std::size_t{4}, std::size_t{100}}) {
    ByteList longer = good;
    longer.resize(good.size() + more, std::byte{'x'});
    const Result<Asset> asset = parse_glb(longer);
    ASSERT_TRUE(asset.ok()) << to_line(asset.issue());
    ASSERT_EQ(asset->remarks.size(), 1U);
    EXPECT_EQ(asset->remarks[0].code, "gltf.bytes_after");
    EXPECT_EQ(asset->remarks[0].text, std::to_string(more) + " bytes follow the end of the GLB; they are not read");
    EXPECT_EQ(asset->nodes, parse_glb(good)->nodes);
  }
}

TEST(GlbContainer, RefusesChunkLengthsThatOverflow) {
  for (const std::uint32_t length : {0xFFFFFFFFU, 0xFFFFFFFCU, 0xFFFFFFECU, 0x80000000U}) {
    ByteList bad = small_arm().glb();
    set_u32(bad, 12, length);
    EXPECT_EQ(code_of(bad), "gltf.truncated") << length;
  }
  ByteList odd = pack_glb("{ }  ", {});
  set_u32(odd, 12, 5);
  EXPECT_EQ(code_of(odd), "gltf.bad_chunk");
}

TEST(GlbContainer, WantsJsonFirstThenBin) {
  constexpr std::uint32_t kBin = 0x004E4942;
  constexpr std::uint32_t kJson = 0x4E4F534A;
  ByteList bin_first = small_arm().glb();
  set_u32(bin_first, 16, kBin);
  EXPECT_EQ(code_of(bin_first), "gltf.bad_chunk");
  const ByteList good = small_arm().glb();
  EXPECT_EQ(code_of(with_chunk(good, kBin, 4)), "gltf.bad_chunk");
  EXPECT_EQ(code_of(with_chunk(good, kJson, 4)), "gltf.bad_chunk");
}

TEST(GlbContainer, IgnoresChunksOfOtherKindsAfterTheFirst) {
  const ByteList glb = small_arm().glb();
  const auto plain = parse_glb(glb);
  const auto more = parse_glb(with_chunk(glb, 0x12345678, 8));
  ASSERT_TRUE(plain.ok() && more.ok());
  EXPECT_EQ(*plain, *more);
}

TEST(JsonScan, LimitsDepthWhateverTheBrackets) {
  const auto nested = [](int depth) {
    return "{\"a\":" + std::string(static_cast<std::size_t>(depth - 1), '[') +
           std::string(static_cast<std::size_t>(depth - 1), ']') + "}";
  };
  EXPECT_TRUE(scan_json(nested(kMaxGltfDepth)).ok());
  ASSERT_FALSE(scan_json(nested(kMaxGltfDepth + 1)).ok());
  EXPECT_EQ(scan_json(nested(kMaxGltfDepth + 1)).issue().code, "gltf.too_deep");
  EXPECT_EQ(scan_json(nested(1'000'000)).issue().code, "gltf.too_deep");
}

TEST(JsonScan, SeesNoBracketsInTexts) {
  EXPECT_TRUE(scan_json("{\"a\":\"" + std::string(1000, '[') + "\\\"" + std::string(1000, '{') + "\"}").ok());
}

TEST(JsonScan, LimitsTheNumberOfValues) {
  std::string many = "{\"a\":[0";
  for (std::uint64_t i = 0; i < kMaxGltfValues; ++i) many += ",0";
  EXPECT_EQ(scan_json(many + "]}").issue().code, "gltf.too_large");
}

TEST(JsonScan, WantsAnObject) {
  for (const char* text : {"", "   ", "[]", "\xEF\xBB\xBF{}", "null"})
    EXPECT_EQ(scan_json(text).issue().code, "gltf.bad_json") << text;
}

}  // namespace
}  // namespace contort
