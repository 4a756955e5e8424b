// Names as files have them, and labels that tell nodes and clips apart.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace contort {

// A name of its own for each: the name, or "<name>#<index>" where that is empty or stands more than once. Then none of
// the equal names keeps it, so that a label never means another node than the name did.
std::vector<std::string> unique_labels(std::span<const std::string> names);

}  // namespace contort
