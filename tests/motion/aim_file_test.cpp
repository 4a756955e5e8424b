// Aim tables in files: intact ones are read back unchanged, and damaged ones are refused.
#include <gtest/gtest.h>

#include <filesystem>

#include "generator/motion/aim_table_file.h"
#include "model/core/hash.h"
#include "tests/motion/aim_scenes.h"

namespace contort {
namespace {

const AimTableOptions kSmall{5.0, 300, 1};

AimGeometry geometry_at(std::size_t row) {
  const fixtures::AimScene scene = fixtures::aim_scene(fixtures::kAimScenes[row]);
  return aim_geometry(scene.character, scene.chain);
}

const AimTable& small_table() {
  static const AimTable table = AimTable::build(geometry_at(2), kSmall);
  return table;
}

std::string code_of(std::string_view bytes, const AimGeometry& geometry, const AimTableOptions& options = kSmall) {
  const Result<AimTable> read = aim_table_from_bytes(bytes, geometry, options);
  return read ? "" : read.issue().code;
}

// Replaces the hash by the one that fits, as a hostile writer would.
std::string rehashed(std::string bytes) {
  bytes.resize(bytes.size() - 8);
  Hash64 hash;
  hash.add(std::string_view(bytes));
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(hash.value() >> (8 * i)));
  return bytes;
}

TEST(AimFile, ComesBackEqual) {
  for (const std::size_t row : {std::size_t{2}, std::size_t{9}, std::size_t{13}}) {
    const AimTable table = AimTable::build(geometry_at(row));
    const Result<AimTable> back = aim_table_from_bytes(aim_table_bytes(table), table.geometry());
    ASSERT_TRUE(back) << to_line(back.issue());
    ASSERT_EQ(back->posture_count(), table.posture_count());
    for (int i = 0; i < table.posture_count(); ++i) {
      EXPECT_TRUE(std::ranges::equal(back->coords(i), table.coords(i)));
      EXPECT_EQ(back->direction(i), table.direction(i));
      EXPECT_EQ(back->point_m(i), table.point_m(i));
    }
  }
}

TEST(AimFile, IsSavedAndLoaded) {
  const std::string path = std::string(CONTORT_BINARY_DIR) + "/aim_file_test.aim";
  ASSERT_TRUE(save_aim_table(small_table(), path));
  const Result<AimTable> back = load_aim_table(path, small_table().geometry(), kSmall);
  std::filesystem::remove(path);
  ASSERT_TRUE(back) << to_line(back.issue());
  EXPECT_EQ(aim_table_bytes(*back), aim_table_bytes(small_table()));
  EXPECT_EQ(load_aim_table(path, small_table().geometry(), kSmall).issue().code, "file.unreadable");
}

TEST(AimFile, EveryTruncationIsRefused) {
  const std::string bytes = aim_table_bytes(small_table());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    ASSERT_EQ(code_of(std::string_view(bytes).substr(0, length), small_table().geometry()), "aim_table.damaged")
        << length;
  EXPECT_EQ(code_of(bytes + '\0', small_table().geometry()), "aim_table.damaged");
  EXPECT_EQ(code_of(bytes, small_table().geometry()), "");
}

TEST(AimFile, EveryFlippedByteIsRefused) {
  std::string bytes = aim_table_bytes(small_table());
  for (char& byte : bytes) {
    byte = static_cast<char>(byte ^ 0x40);
    ASSERT_NE(code_of(bytes, small_table().geometry()), "") << &byte - bytes.data();
    byte = static_cast<char>(byte ^ 0x40);
  }
}

TEST(AimFile, OtherVersionsAndChainsAreRefusedByName) {
  std::string bytes = aim_table_bytes(small_table());
  EXPECT_EQ(code_of(bytes, geometry_at(0)), "aim_table.other_chain");
  EXPECT_EQ(code_of(bytes, geometry_at(13)), "aim_table.other_chain");
  EXPECT_EQ(code_of(bytes, small_table().geometry(), {5.0, 300, 2}), "aim_table.other_chain");
  bytes[8] = static_cast<char>(bytes[8] + 1);
  EXPECT_EQ(code_of(rehashed(bytes), small_table().geometry()), "aim_table.version");
}

TEST(AimFile, HostileSizesAndPosturesAreRefused) {
  const std::string good = aim_table_bytes(small_table());
  for (const char high : {'\x00', '\x01', '\x7f', '\xff'}) {
    std::string bytes = good;
    bytes[24] = bytes[25] = bytes[26] = bytes[27] = high;  // the number of postures
    EXPECT_EQ(code_of(rehashed(bytes), small_table().geometry()), "aim_table.damaged");
  }
  for (const char high : {'\x7f', '\xff', '\x40'}) {
    std::string bytes = good;
    bytes[39] = bytes[38] = high;  // a coordinate: huge, NaN, or 40
    EXPECT_EQ(code_of(rehashed(bytes), small_table().geometry()), "aim_table.out_of_range");
  }
}

}  // namespace
}  // namespace contort
