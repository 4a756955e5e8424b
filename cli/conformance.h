// The results of `contort generator check` about a generator that is a program of its own.
#pragma once

#include <string>
#include <vector>

#include "corpus/refusals.h"
#include "guest/guest_generator.h"

namespace contort::cli {

struct ProtocolRemark {
  bool is_fault = false;  // true: a fault; false: a note for people
  std::string text;       // one sentence that describes the necessary change
  bool operator==(const ProtocolRemark&) const = default;
};

struct Conformance {
  std::vector<ProtocolRemark> remarks;
  std::string determinism;  // one sentence
  std::vector<std::string> judged;                             // names of checks
  std::vector<std::pair<std::string, std::string>> not_judged;  // with the reasons
  int motions = 0;
  RefusalCounts refusals;  // reasons for which drawn motions were refused
  int refused = 0;         // number of drawn motions that were refused
  double frames_per_s = 0.0;
  double start_s = 0.0;

  bool has_fault() const;
};

// Requests the rest pose, motions that are drawn like those of a run, the ends of every parameter, and one motion
// several times in several processes. Takes seconds.
Conformance check_conformance(GuestGenerator& generator);

}  // namespace contort::cli
