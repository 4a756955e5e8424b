// The identity of a failure, without numbers: the check, the character and the subject.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace contort {

struct Family {
  std::string check;      // "joint_range", or the way in which a process ended: "crash"
  std::string character;  // "human"
  std::string subject;    // "arm_left/elbow max"; for a crash the signal

  bool operator==(const Family&) const = default;
  std::strong_ordering operator<=>(const Family& other) const;  // orders families as their texts
  bool empty() const { return *this == Family{}; }              // returns true for no family
};

// The family as text for files and people, such as "joint_range|human|arm_left/elbow max"; "" for the empty family.
std::string print_family(const Family& family);

// Parses the text of print_family. Returns nothing if a part is missing. Only the subject may contain the separator.
std::optional<Family> parse_family(std::string_view text);

}  // namespace contort
