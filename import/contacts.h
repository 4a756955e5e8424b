// Finds contacts that no motion of a character can avoid, as proposals for its file's `allowed_pairs`.
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
  int in_poses = 0;  // pairs that overlap in poses of clips, or in sampled poses
  int left_out = 0;  // pairs beyond the number that a character may list
};

// Returns the pairs of colliders that overlap at rest, or in a tenth of the poses of the model's own clips. `joints`
// maps the labels of nodes, including the root's, to joints of the character.
OwnContacts find_contacts(const Character& character, const Asset& asset,
                          const std::map<std::string, std::string>& joints);

// Returns the judged pairs of colliders that overlap at rest, or in 95 % of poses that are spread over the ranges of
// all joints, as MoveIt's setup assistant samples them (moveit.picknik.ai). Equal characters give equal poses.
OwnContacts propose_contacts(const Character& character, int poses);

}  // namespace contort
