// Reads the meaning of joints' names.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "import/figure.h"

namespace contort {

// "mixamorig:LeftForeArm" to {"mixamorig", "left", "fore", "arm"}; ASCII only, everything else separates.
std::vector<std::string> words_of(std::string_view name);

struct NameSense {
  BoneFamily family = BoneFamily::unknown;
  Side side = Side::center;
  bool operator==(const NameSense&) const = default;
};

NameSense sense_of(std::string_view name);

// The same of a bone in VRM's list, "leftUpperArm"; unknown for what VRM does not have.
NameSense sense_of_vrm(std::string_view bone);

// A legal name, [a-z0-9_]{1,32}, from any bytes; `fallback` where nothing is left.
std::string legal_name(std::string_view any, std::string_view fallback);

// The name, or "<name>_2", "<name>_3" where it is taken already; remembers it.
std::string claim_name(const std::string& name, std::set<std::string>& taken);

}  // namespace contort
