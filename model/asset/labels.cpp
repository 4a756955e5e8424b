#include "model/asset/labels.h"

#include <map>

namespace contort {

std::vector<std::string> unique_labels(std::span<const std::string> names) {
  std::map<std::string, int> uses;
  for (const std::string& name : names) ++uses[name];
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string label = names[i];
    const bool is_unique = !label.empty() && uses[label] == 1;
    // Repeats the number if the file itself has a name like "hand#3".
    while (!is_unique && (label == names[i] || uses.contains(label))) label += "#" + std::to_string(i);
    uses.try_emplace(label, 1);
    labels.push_back(std::move(label));
  }
  return labels;
}

}  // namespace contort
