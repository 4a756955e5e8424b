// Failures of the left side and of the right: two buckets, and often one fault.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/bucket.h"

namespace contort {

// The family with "left" and "right" exchanged in the names of its subject, pairs in order again:
// "self_collision|human|arm_left/hand ~ head" has "self_collision|human|arm_right/hand ~ head".
Family other_side(const Family& family);

// Buckets that are alike but for the side stand together, as indices, each group and all groups in the given order.
std::vector<std::vector<std::size_t>> without_sides(const std::vector<Bucket>& buckets);

}  // namespace contort
