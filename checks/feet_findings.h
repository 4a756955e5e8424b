// The findings of foot_slide and ground_penetration in a clip that is judged by the file's own skeleton.
#pragma once

#include <string_view>

#include "checks/clip_check.h"

namespace contort {

enum class FootCheck { slide, sink };

ClipCheckResult judge_feet_in_clip(const ClipInput& in, FootCheck which);

}  // namespace contort
