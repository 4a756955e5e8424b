// Values that a generator gives for each frame in addition to the pose.
#pragma once

#include <vector>

#include "model/motion/foreign.h"

namespace contort {

struct ChannelFacts {
  std::vector<ChannelRun> runs;
  std::vector<ChannelNumbers> numbers;
};

}  // namespace contort
