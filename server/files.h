// Files that pages load, from folders of ours.
#pragma once

#include <string>

#include "generator/core/result.h"

namespace contort::server {

// A plain file below `folder`, whose way there has neither links nor "..". `path` is what a request asked for, relative. Code
// call.not_found, whatever the reason: who asks learns nothing of what else there is.
Result<std::string> read_below(const std::string& folder, const std::string& path);

// By the ending; application/octet-stream for those that are not known.
std::string type_of(const std::string& path);

}  // namespace contort::server
