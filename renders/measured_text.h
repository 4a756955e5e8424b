// Prints the measured value of a failed check, with its limit.
#pragma once

#include <string>
#include <string_view>

#include "checks/measured.h"

namespace contort {

// Returns a text such as "turns 3 600 °/s, limit 733 °/s" or "slides 240 mm, limit 20 mm" in familiar units. `unit` is
// that of the check's margins.
std::string measured_text(std::string_view check, std::string_view unit, const Measured& measured);

// A failure that a sentence is about: the worst margin of a subject.
struct Failed {
  std::string_view check, subject, unit;
  double margin = 0.0;
  bool has_own_limit = false;  // true: the program under test said how near this one must come
};

// Returns measured_text() if the character and the margin determine value and limit. Otherwise it says how far beyond
// its limit the subject is: "bends 73° beyond its swing cone", "the figure falls". Without a character (nullptr) value
// and limit are unknown.
std::string failed_text(const Failed& failed, const Character* character, const CheckSettings& settings);

}  // namespace contort
