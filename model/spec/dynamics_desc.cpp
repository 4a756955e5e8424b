#include "model/spec/dynamics_desc.h"

#include <array>

namespace contort {

namespace {

constexpr std::array<std::string_view, 3> kModes = {"kinematic", "tracking", "dynamic"};

}  // namespace

std::span<const std::string_view> mode_names() { return kModes; }

}  // namespace contort
