// The legend of a film strip: one line that explains the signs and colours which its pictures show.
#pragma once

#include <span>
#include <string>

#include "renders/shots.h"

namespace contort {

// Returns a line such as "grey: target; orange arrows: added by dynamics; violet: obstacle", with only those signs that
// occur in the lists; "" if there is none.
std::string legend_of(const Story& story, std::span<const DrawList> lists);

}  // namespace contort
