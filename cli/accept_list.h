// Accepted findings of a library of animations, by file, clip, check and joint. They do not fail a run. Entries that no
// finding matches are reported, so that the list shrinks as faults are repaired.
//
//   {"format": "contort.accept/1",
//    "accepted": [{"file": "idle/look.glb", "clip": "look", "check": "pop", "joint": "LeftArm", "reason": "a glitch"}]}
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/result.h"

namespace contort::cli {

struct AcceptedFinding {
  std::string file;   // path below the folder that is checked; for a file on the command line, only its name
  std::string clip;   // label
  std::string check;
  std::string joint;  // the finding's subject
  std::string reason;

  // Compares the key by which findings are recognised: all fields except for the reason.
  bool is_same(const AcceptedFinding& other) const {
    return file == other.file && clip == other.clip && check == other.check && joint == other.joint;
  }
  bool operator==(const AcceptedFinding&) const = default;
};

struct AcceptList {
  std::vector<AcceptedFinding> accepted;
  bool operator==(const AcceptList&) const = default;
};

// Codes json.* and accept.*.
Result<AcceptList> parse_accept_list(std::string_view text);
std::string print_accept_list(const AcceptList& list);
std::string accept_list_schema();

// Reads the list in a file; empty for the path "".
Result<AcceptList> read_accept_list(const std::string& path);

// The name of a file in accept lists, if these folders and files were named on the command line.
std::string name_in_accept_list(const std::string& file, const std::vector<std::string>& named);

// The entry of the list that accepts the finding, or -1.
int index_in(const AcceptList& list, const AcceptedFinding& finding);

// "idle/look.glb: clip look: pop at LeftArm".
std::string accepted_text(const AcceptedFinding& finding);

}  // namespace contort::cli
