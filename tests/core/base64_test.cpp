#include "model/core/base64.h"

#include <gtest/gtest.h>

#include <string_view>

namespace contort {
namespace {

std::string encoded(std::string_view text) { return to_base64(std::as_bytes(std::span(text))); }

// RFC 4648, section 10; and every digit from 0 to 63.
TEST(Base64, IsThatOfTheStandard) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded(std::string_view("\x00\x10\x83\x10\x51\x87\xff\xfe\xfb", 9)), "ABCDEFGH//77");
}

}  // namespace
}  // namespace contort
