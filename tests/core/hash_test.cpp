#include "model/core/hash.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace contort {
namespace {

std::uint64_t hash_of(const std::vector<double>& values) {
  Hash64 hash;
  hash.add(std::span<const double>(values));
  return hash.value();
}

std::uint64_t hash_of_text(std::string_view text) {
  Hash64 hash;
  hash.add(text);
  return hash.value();
}

TEST(Hash, MinusZeroIsZero) { EXPECT_EQ(hash_of({-0.0, 1.0}), hash_of({0.0, 1.0})); }

TEST(Hash, AllNaNsAreOne) {
  const double quiet = std::numeric_limits<double>::quiet_NaN();
  const double other = std::bit_cast<double>(0xfff8000000000123ULL);
  ASSERT_TRUE(std::isnan(other));
  EXPECT_EQ(hash_of({quiet}), hash_of({other}));
  EXPECT_EQ(hash_of({quiet}), hash_of({-quiet}));
  EXPECT_NE(hash_of({quiet}), hash_of({std::numeric_limits<double>::infinity()}));
}

// Every step is a bijection of the state, so two lists that differ in one word never meet again.
RC_GTEST_PROP(Hash, OneChangedBitChangesIt, (std::vector<std::uint64_t> words, std::uint8_t which)) {
  if (words.empty()) words.push_back(0);
  Hash64 before;
  for (const std::uint64_t word : words) before.add(word);
  words[which % words.size()] ^= std::uint64_t{1} << which % 64;
  Hash64 after;
  for (const std::uint64_t word : words) after.add(word);
  RC_ASSERT(before.value() != after.value());
}

TEST(Hash, EveryBitOfANumberCounts) {
  std::set<std::uint64_t> seen = {hash_of({1.5})};
  for (int bit = 0; bit < 52; ++bit)
    seen.insert(hash_of({std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.5) ^ std::uint64_t{1} << bit)}));
  EXPECT_EQ(seen.size(), 53U);
}

TEST(Hash, TheOrderCounts) { EXPECT_NE(hash_of({1.0, 2.0}), hash_of({2.0, 1.0})); }

TEST(Hash, TextsDoNotRunTogether) {
  const auto two = [](std::string_view a, std::string_view b) {
    Hash64 hash;
    hash.add(a);
    hash.add(b);
    return hash.value();
  };
  EXPECT_NE(two("ab", "c"), two("a", "bc"));
  EXPECT_NE(hash_of_text(""), Hash64().value());
  EXPECT_NE(hash_of_text("\xff"), hash_of_text("\x7f"));
}

TEST(Hash, ValuesAreFixedForAllTime) {
  EXPECT_EQ(to_hex(hash_of({0.0, 1.0, -2.5})), "8201ff3db4681954");
  EXPECT_EQ(content_id("contort"), "22397e29790d2a72d979a30b4bd6d43f");
  EXPECT_EQ(content_id(""), "99aa06d3014798d86001c324468d497f");  // XXH3-128 of the empty text, from xxhash's own tests
}

RC_GTEST_PROP(Hash, HexComesBack, (std::uint64_t value)) {
  std::uint64_t back = ~value;
  RC_ASSERT(to_hex(value).size() == 16U);
  RC_ASSERT(from_hex(to_hex(value), back));
  RC_ASSERT(back == value);
}

TEST(Hash, HexIsSixteenLowerCaseDigits) {
  EXPECT_EQ(to_hex(0xabcULL), "0000000000000abc");
  std::uint64_t value = 0;
  for (const char* bad : {"", "0", "000000000000000g", "0000000000000ABC", "0x00000000000abc", "00000000000000abc",
                          " 00000000000abc ", "-000000000000abc"})
    EXPECT_FALSE(from_hex(bad, value)) << bad;
}

TEST(Hash, ContentIdsFollowTheText) {
  EXPECT_EQ(content_id("a").size(), 32U);
  EXPECT_EQ(content_id("a").find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(content_id("a"), content_id("b"));
  EXPECT_NE(content_id(std::string_view("a\0", 2)), content_id("a"));
}

}  // namespace
}  // namespace contort
