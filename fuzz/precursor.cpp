#include "fuzz/precursor.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "checks/check.h"
#include "corpus/bucket.h"

namespace contort {

namespace {

bool are_of_one_time(const Case& a, const Case& b) {
  const double between = kOneTime_s * a.spec.rate_hz;
  return a.expect.first_frame - b.expect.last_frame <= between && b.expect.first_frame - a.expect.last_frame <= between;
}

// The order of failures. NaN breaks the limits of every check, so among equal failures the check of broken numbers
// comes first.
auto place_of(const Case& shown) {
  const bool is_broken = kind_of_check(shown.expect.check) == CheckKind::broken;
  return std::tuple(shown.expect.first_frame, -depth_of(shown.expect), !is_broken, family_of(shown));
}

Shrunk added_up(const Shrunk& before, Shrunk after) {
  after.evaluations += before.evaluations;
  for (Case* stored : {&after.minimal, &after.worst})
    stored->provenance.shrink_evaluations += before.minimal.provenance.shrink_evaluations;
  for (const Case& other : before.met) {
    const auto known = std::ranges::find_if(
        after.met, [family = family_of(other)](const Case& met) { return family_of(met) == family; });
    if (known == after.met.end())
      after.met.push_back(other);
    else if (cheaper(other.spec, known->spec))
      *known = other;
  }
  return after;
}

}  // namespace

const Case* precursor_of(const Case& shown, const std::vector<Case>& others, const std::set<Family>& left) {
  const Case* first = &shown;
  for (const Case& other : others) {
    const bool leads = are_of_one_time(shown, other) && depth_of(other.expect) >= depth_of(shown.expect);
    if (leads && place_of(other) < place_of(*first) && !left.contains(family_of(other))) first = &other;
  }
  return first == &shown ? nullptr : first;
}

Shrunk shrink_to_precursor(const Case& original, const ShrinkStep& shrink_step) {
  PrimarySearch search;
  Shrunk shrunk = shrink_step(original, search);
  while (shrunk.precursor) {
    search.begin_with = shrunk.minimal.spec;
    search.left.insert(family_of(shrunk.minimal));
    Shrunk next = shrink_step(*shrunk.precursor, search);
    if (next.stopped == "flaky" || next.stopped == "gone") break;
    shrunk = added_up(shrunk, std::move(next));
  }
  return shrunk;
}

}  // namespace contort
