#include "model/core/number_text.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

TEST(NumberText, IsShortWhateverTheNumber) {
  EXPECT_EQ(number_text(150.0), "150");
  EXPECT_EQ(number_text(-1.5), "-1.5");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(number_text(1e308), "1e+308");
  EXPECT_EQ(number_text(1e-9), "1e-09");
}

}  // namespace
}  // namespace contort
