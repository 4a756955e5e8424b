// Finds the meaning of joints' names.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "import/figure.h"

namespace contort {

// Splits a name into words: "mixamorig:LeftForeArm" gives {"mixamorig", "left", "fore", "arm"}. Only ASCII letters
// form words; everything else separates.
std::vector<std::string> words_of(std::string_view name);

struct NameSense {
  BoneFamily family = BoneFamily::unknown;
  Side side = Side::center;
  bool operator==(const NameSense&) const = default;
};

NameSense sense_of(std::string_view name);

// Returns the meaning of a bone in VRM's list, such as "leftUpperArm"; unknown for other names.
NameSense sense_of_vrm(std::string_view bone);

// Makes a valid name, [a-z0-9_]{1,32}, from any bytes; `fallback` if nothing remains.
std::string legal_name(std::string_view any, std::string_view fallback);

// Returns the name, or "<name>_2", "<name>_3" if it is taken already, and adds it to `taken`.
std::string claim_name(const std::string& name, std::set<std::string>& taken);

}  // namespace contort
