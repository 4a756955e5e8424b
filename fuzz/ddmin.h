// Delta debugging (Zeller and Hildebrandt 2002), by complements: which of a row of units can go.
#pragma once

#include <functional>

namespace contort {

// `count`: how many units are left. `remove(first, n)`: takes those away if what remains still holds; whether it did.
// Afterwards no single unit can go. Units are taken by halves, quarters, … so k of n that are needed cost about
// k log n tries, where units do not depend on each other.
void ddmin(const std::function<int()>& count, const std::function<bool(int first, int n)>& remove);

}  // namespace contort
