// The checks of clips made elsewhere that no figure of Contort's own has. Settings name them like those of the
// manifest.
#pragma once

#include <span>
#include <string_view>

namespace contort {

struct ClipCheckDef {
  std::string_view name;
  double scale;
  std::string_view help;
};

std::span<const ClipCheckDef> clip_checks();

}  // namespace contort
