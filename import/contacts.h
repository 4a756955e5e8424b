// Contacts that no motion of a character could do without: proposals for its file's `allowed_pairs`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/asset/asset.h"
#include "model/character/character.h"

namespace contort {

struct OwnContacts {
  std::vector<AllowedPairDesc> pairs;  // deepest first
  int at_rest = 0;
  int in_poses = 0;  // of clips, or sampled
  int left_out = 0;  // more than a character may list
};

// Pairs of colliders that overlap at rest, and those that do in a tenth of the poses of the model's own clips. `joints`
// gives the character's joint for a node's label, the root's too.
OwnContacts find_contacts(const Character& character, const Asset& asset,
                          const std::map<std::string, std::string>& joints);

// Pairs of colliders that are judged and overlap at rest, and those that do in 95 % of poses that are spread over the
// ranges of all joints, as MoveIt's setup assistant samples them (moveit.picknik.ai). Equal poses for equal characters.
OwnContacts propose_contacts(const Character& character, int poses);

}  // namespace contort
