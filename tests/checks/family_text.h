// Families in tests: from their texts, and in messages.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string_view>

#include "checks/family.h"

namespace contort {

inline Family family(std::string_view text) {
  const std::optional<Family> parsed = parse_family(text);
  EXPECT_TRUE(parsed) << text;
  return parsed.value_or(Family{});
}

inline std::ostream& operator<<(std::ostream& out, const Family& shown) { return out << print_family(shown); }

}  // namespace contort
