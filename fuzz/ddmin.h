// Delta debugging (Zeller and Hildebrandt 2002), by complements: finds the units of a list that can be removed.
#pragma once

#include <functional>

namespace contort {

// `count` returns the number of units left. `remove(first, n)` removes those units if the failure remains, and returns
// whether it did. Afterwards no single unit can be removed. Units are taken by halves, quarters, … so if k of n units
// are needed, it makes about k log n tries, provided that units do not depend on each other.
void ddmin(const std::function<int()>& count, const std::function<bool(int first, int n)>& remove);

}  // namespace contort
