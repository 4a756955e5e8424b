#include "cli/similar_names.h"

#include <algorithm>
#include <set>
#include <vector>

namespace contort::cli {

namespace {

// The common beginning of all names in the map.
std::string shared_beginning(const std::map<std::string, std::string>& joints) {
  std::string shared = joints.begin()->first;
  for (const auto& [node, joint] : joints) {
    const auto end = std::ranges::mismatch(shared, node).in1;
    shared.erase(end, shared.end());
  }
  return shared;
}

std::set<std::string> names_of(const Asset& asset) {
  std::set<std::string> names;
  for (const AssetNode& node : asset.nodes) names.insert(node.label);
  return names;
}

// The prefixes before a name of the map, for a node of the map.
std::set<std::string> prefixes(const std::set<std::string>& names, const std::string& bare) {
  std::set<std::string> out;
  for (const std::string& name : names)
    if (name.ends_with(bare)) out.insert(name.substr(0, name.size() - bare.size()));
  return out;
}

}  // namespace

std::map<std::string, std::string> similar_names(const Asset& asset, const std::map<std::string, std::string>& joints) {
  std::map<std::string, std::string> best;
  if (joints.size() < 2) return best;
  const std::set<std::string> names = names_of(asset);
  if (std::ranges::any_of(joints, [&](const auto& entry) { return names.contains(entry.first); })) return best;
  const std::size_t shared = shared_beginning(joints).size();
  std::set<std::string> tried;
  for (const auto& [node, joint] : joints)
    for (const std::string& prefix : prefixes(names, node.substr(shared))) {
      if (!tried.insert(prefix).second) continue;
      std::map<std::string, std::string> found;
      for (const auto& [other, ignored] : joints)
        if (names.contains(prefix + other.substr(shared))) found.emplace(prefix + other.substr(shared), other);
      if (found.size() > best.size()) best = std::move(found);
    }
  if (best.size() < 2 || 2 * best.size() < joints.size()) best.clear();
  return best;
}

}  // namespace contort::cli
