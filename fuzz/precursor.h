// Chooses the name of a failure that occurs together with others.
//
// One fault often breaks several limits at the same time: a knee that snaps straight is too fast, and so is its hip,
// which pops, and the foot leaves its place. The minimal spec shows all of them, whichever one it was shrunk for. So
// the earliest failure that is near in time and at least as deep gives all of them their name
// (docs/internals/shrinking.md, "Who names it").
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "corpus/case.h"
#include "fuzz/shrink.h"

namespace contort {

// Two failures occur together if at most this time lies between them. Measured on planted faults, the median number of
// buckets for each fault is 5.5 if each family has its own, 4.5 if the failures overlap or are up to 0.1 s apart, and 4
// with 0.2 s to 1 s. With any distance in time, three of 36 faults had only buckets of known ones.
inline constexpr double kOneTime_s = 0.2;

// Chooses, from the other families of one motion, the earliest that occurs together with `shown` and is at least as
// deep (in each check's scale); among equally early ones the deepest, and among these a check of broken numbers. It
// never chooses a family in `left`. Null if `shown` itself is the earliest.
const Case* precursor_of(const Case& shown, const std::vector<Case>& others, const std::set<Family>& left = {});

using ShrinkStep = std::function<Shrunk(const Case& original, const PrimarySearch& search)>;

// Shrinks the failure, then its precursor, then the precursor of that, until there is none that was not shrunk before.
// The result may be of another family than `original`. `evaluations` and `met` cover all these shrinks; `met` has the
// cheapest spec of each family.
Shrunk shrink_to_precursor(const Case& original, const ShrinkStep& shrink_step);

}  // namespace contort
