// ASF (Acclaim skeleton file): reads a skeleton with its limits. Its motions are AMC files, see amc.h.
#pragma once

#include <string>
#include <string_view>

#include "model/asset/capture.h"
#include "model/core/result.h"

namespace contort {

// Codes "asf.*"; the pointer is a line: "line 12".
Result<AsfSkeleton> read_asf(const std::string& path);
Result<AsfSkeleton> parse_asf(std::string_view text);

}  // namespace contort
