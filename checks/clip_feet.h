// Judges the feet of a clip's own skeleton. The ground is where feet stood still on their soles. Lengths are fractions
// of the leg, because not all files use metres.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/asset/asset.h"

namespace contort {

// A leg, as nodes of the file. Each node carries the next.
struct ClipFoot {
  std::string name;  // name of the node in findings
  int hip = 0;
  int ankle = 0;
  int toe = 0;  // the ball or the end of the foot
  bool operator==(const ClipFoot&) const = default;
};

// The worst moment of a foot.
struct FootFault {
  int foot = 0;
  double amount = 0.0;  // length of the slide, or depth, in leg lengths
  double leg = 0.0;     // its length, in the file's unit
  double first_s = 0.0, worst_s = 0.0, last_s = 0.0;
  bool operator==(const FootFault&) const = default;
};

inline constexpr double kClipSlide = 0.25;       // greatest slide within two seconds: 22 cm for a person
inline constexpr double kClipSlideTime_s = 2.0;
inline constexpr double kClipSink = 0.06;        // greatest depth in the ground: 5 cm for a person

struct ClipFeetFaults {
  int judged = 0;             // number of judged feet
  std::string_view why_not;   // the reason if none could be judged
  std::string_view no_slide;  // the reason if slides could not be judged
  std::vector<FootFault> slides;
  std::vector<FootFault> sinks;
  std::vector<FootFault> drifts;  // drifts of the figure as a whole, even if the ground is unknown; at most one
};

// The ground is the height at which feet stay longest. A foot slides if ankle, toe and the middle between them all
// leave their places while both are at their heights on the ground and the figure is upright. A movement that is over
// at once is no slide, but a step without lifting the foot. A foot sinks if it is below the ground while another foot
// stands on it, in the place where it stood before. A figure drifts if it rises or sinks while all feet keep their
// places and no leg bends, and does not come back; this needs no ground. If the figure stays in place and all feet move
// the same way, it walks on the spot, and slides are not judged.
ClipFeetFaults faults_of_feet(const Asset& asset, const AssetClip& clip, const std::vector<ClipFoot>& feet);

}  // namespace contort
