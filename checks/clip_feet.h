// The feet of a clip's own skeleton on ground that the clip tells itself: where a foot stood still on its sole, there is
// the ground. Lengths are in parts of the leg, as files have other units than metres.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/asset/asset.h"

namespace contort {

// A leg, as nodes of the file: each carries the next.
struct ClipFoot {
  std::string name;  // of the node that findings are about
  int hip = 0;
  int ankle = 0;
  int toe = 0;  // the ball or the end of the foot
  bool operator==(const ClipFoot&) const = default;
};

// The worst moment of a foot.
struct FootFault {
  int foot = 0;
  double amount = 0.0;  // of the slide, or of the depth, in lengths of the leg
  double leg = 0.0;     // its length, in the file's unit
  double first_s = 0.0, worst_s = 0.0, last_s = 0.0;
  bool operator==(const FootFault&) const = default;
};

inline constexpr double kClipSlide = 0.25;       // within two seconds: 22 cm of a person
inline constexpr double kClipSlideTime_s = 2.0;
inline constexpr double kClipSink = 0.06;        // below the ground: 5 cm of a person

struct ClipFeetFaults {
  int judged = 0;             // feet
  std::string_view why_not;   // the reason if none could be judged
  std::string_view no_slide;  // the reason if slides could not
  std::vector<FootFault> slides;
  std::vector<FootFault> sinks;
  std::vector<FootFault> drifts;  // of the figure as a whole, whether the ground is known or not; at most one
};

// The ground is the height at which feet stay longest. A foot slides if ankle, toe and the middle between
// them all leave their places while both are at their heights on the ground, in a figure that is upright. A move that
// is over at once is a step of a foot that was not lifted, and no slide. A foot sinks if it is below the ground while
// another one stands on it, in the place where it stood before. A figure drifts if it goes up or down while all feet
// keep their places and no leg bends, and does not come back; for that the ground need not be known. Feet that are all
// pulled the same way in a figure that stays are those of a walk on the spot, and are not judged.
ClipFeetFaults faults_of_feet(const Asset& asset, const AssetClip& clip, const std::vector<ClipFoot>& feet);

}  // namespace contort
