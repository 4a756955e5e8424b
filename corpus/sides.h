// Relates failures of the left and the right side: they are two buckets, and often have one cause.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/bucket.h"

namespace contort {

// The family with "left" and "right" exchanged in the names of its subject, and pairs sorted again:
// "self_collision|human|arm_left/hand ~ head" becomes "self_collision|human|arm_right/hand ~ head".
Family other_side(const Family& family);

// Groups buckets that differ only in the side, as indices. The groups, and the buckets in each group, keep the given
// order.
std::vector<std::vector<std::size_t>> without_sides(const std::vector<Bucket>& buckets);

}  // namespace contort
