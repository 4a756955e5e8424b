// The features that a case may have: those that its profile allows, without those that the case itself leaves out.
//
// Leaving out half of all features in each case is swarm testing (Groce et al., ISSTA 2012): some faults show only if
// other features do not interfere.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/profile.h"

namespace contort {

class Features {
 public:
  Features(const Profile& profile, int omitted) : profile_(profile), omitted_(omitted) {}

  const Profile& profile() const { return profile_; }
  // "slot", "action" or "ground" with a name, "interrupt", "swap", "object", "obstacle", "blend", "speed", "stretch".
  bool omits(std::string_view kind, std::string_view name = {}) const;
  // Returns the list without features that are not allowed. If none is left, it returns those that the profile allows;
  // if none of those is left either, the whole list.
  template <class T, class NameOf>
  std::vector<T> among(const std::vector<T>& list, std::string_view kind, const std::vector<std::string>& allowed,
                       const NameOf& name_of) const;

 private:
  const Profile& profile_;
  int omitted_;
};

template <class T, class NameOf>
std::vector<T> Features::among(const std::vector<T>& list, std::string_view kind,
                               const std::vector<std::string>& allowed, const NameOf& name_of) const {
  std::vector<T> of_profile, of_case;
  for (const T& item : list) {
    const std::string_view name = name_of(item);
    if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), name) == allowed.end()) continue;
    of_profile.push_back(item);
    if (!omits(kind, name)) of_case.push_back(item);
  }
  return of_case.empty() ? of_profile : of_case;
}

}  // namespace contort
