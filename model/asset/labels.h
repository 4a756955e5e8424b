// Makes unique labels for nodes and clips from the names in a file.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace contort {

// Returns a unique label for each name: the name itself, or "<name>#<index>" if it is empty or occurs more than once.
// In the second case none of the equal names keeps it, so that a label never means another node than the name did.
std::vector<std::string> unique_labels(std::span<const std::string> names);

}  // namespace contort
