// Chooses the name of a failure that does not come alone.
//
// One fault mostly breaks several limits at one time: a knee that snaps straight is too fast, and so is its hip, which
// pops, and the foot leaves its place. Whichever of them a case was shrunk for, the minimal spec shows them together.
// The earliest failure that is as deep, of those at one time, names them all (docs/shrinking.md, "Who names it").
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "corpus/case.h"
#include "fuzz/shrink.h"

namespace contort {

// Two failures are of one time if no more than this lies between them. Measured on planted faults: buckets to a fault,
// in the median, are 5.5 if each family has its own, 4.5 with what overlaps to 0.1 s, 4 with 0.2 s to 1 s. What lies
// apart is another matter: with any time, three of 36 faults had no bucket left but those of known ones.
inline constexpr double kOneTime_s = 0.2;

// Chooses from the other families of one motion the earliest that is of one time with `shown` and at least as deep (in
// each check's scale), of equally early ones the deepest, and of these one about broken numbers; none of those that
// were left. Null where `shown` itself is that one.
const Case* precursor_of(const Case& shown, const std::vector<Case>& others, const std::set<Family>& left = {});

using ShrinkStep = std::function<Shrunk(const Case& original, const PrimarySearch& search)>;

// Shrinks, and shrinks on to the precursor and that one's, until there is none that it did not come by. What is handed
// back may be of another family than `original`. `evaluations` and what was met are of all together, the latter with
// the cheapest spec of each family.
Shrunk shrink_to_precursor(const Case& original, const ShrinkStep& shrink_step);

}  // namespace contort
