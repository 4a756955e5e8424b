// quaternion_length: a rotation is a quaternion of length 1. Another length scales and shears what it turns.
#include <cmath>

#include "checks/check.h"

namespace contort {

namespace {

constexpr double kLengthLimit = 1e-3;

}  // namespace

int quaternion_length_subject_count(const Character& character) { return static_cast<int>(character.joints().size()); }

Subject quaternion_length_subject(const Character& character, int subject) {
  return {character.joints()[static_cast<std::size_t>(subject)].name, "length"};
}

void quaternion_length_measure(const CheckInput& in, MarginFold& fold) {
  const std::size_t joints = in.character.joints().size();
  const std::vector<double>& lengths = in.foreign->quaternion_lengths;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    fold.report(static_cast<int>(i % joints), static_cast<int>(i / joints), kLengthLimit - std::fabs(lengths[i] - 1.0));
}

}  // namespace contort
