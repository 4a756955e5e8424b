// Plain words for checks and for the reasons of the generator, for people who have never read the manifest.
#pragma once

#include <string>
#include <string_view>

#include "model/motion/intent.h"

namespace contort {

// Returns a plain name such as "Goes through itself" for "self_collision"; the identifier itself if it is not known.
std::string check_title(std::string_view check);

// Returns the reason why a request was not met as half a sentence: "it is out of reach".
std::string_view shortfall_text(Shortfall why);

// Returns the same for a shortfall_name(); the name itself if it is not known.
std::string_view shortfall_text(std::string_view name);

}  // namespace contort
