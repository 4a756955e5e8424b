// An arm of two joints that swings. Build it with `g++ -std=c++17 -O2 walker.cpp -o walker` and run it with
// contort fuzz --generator ./walker --cases 500
#include "contort_guest.h"

namespace {

constexpr char kManifest[] = R"({
  "contort": 1,
  "name": "walker",
  "characters": [{"name": "hero", "joints": [
    {"name": "shoulder", "position": [0, 1.4, 0], "swing_deg": 130},
    {"name": "elbow", "parent": "shoulder", "position": [0, -0.3, 0], "type": "hinge", "axis": [1, 0, 0],
     "low_deg": -150, "high_deg": 0}]}],
  "actions": [{"name": "swing", "help": "Raises the arm, bends the elbow, and comes back.", "duration_s": [0.5, 2],
    "params": {"angle_deg": {"type": "number", "low": -90, "high": 90, "default": 45},
               "bend_deg": {"type": "number", "low": 0, "high": 110, "special": [90]}}}]
})";

enum Joint { kShoulder, kElbow };

void generate(const contort_guest::Request& request, contort_guest::Motion& motion) {
  for (int frame = 0; frame < motion.frames(); ++frame) {
    double raised_deg = 0.0, bent_deg = 0.0;
    for (const contort_guest::Use& use : request.uses) {
      const double wave = std::sin(3.14159265358979 * use.progress(frame / request.rate_hz));
      raised_deg += wave * wave * use.params["angle_deg"].number;
      bent_deg += wave * wave * use.params["bend_deg"].number;
    }
    motion.turn(frame, kShoulder, {1, 0, 0}, raised_deg);
    motion.turn(frame, kElbow, {1, 0, 0}, -bent_deg);
  }
}

}  // namespace

int main() { return contort_guest::serve(kManifest, generate); }
