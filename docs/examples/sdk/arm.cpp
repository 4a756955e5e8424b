// A generator with a fault: an arm whose elbow can be asked to bend further than it can.
#include <contort/contort_guest.h>

#include <algorithm>

namespace {

constexpr char kManifest[] = R"({
  "contort": 1,
  "name": "arm",
  "characters": [{"name": "hero", "joints": [
    {"name": "shoulder", "position": [0, 1.4, 0], "swing_deg": 130},
    {"name": "elbow", "parent": "shoulder", "position": [0, -0.3, 0], "type": "hinge", "axis": [1, 0, 0],
     "low_deg": -150, "high_deg": 0, "max_speed_deg_s": 4000}]}],
  "actions": [{"name": "bend", "help": "Bends the elbow and comes back.", "duration_s": [0.5, 2],
    "params": {"angle_deg": {"type": "number", "low": 0, "high": 180, "default": 45}}}]
})";

enum Joint { kShoulder, kElbow };

void generate(const contort_guest::Request& request, contort_guest::Motion& motion) {
  for (int frame = 0; frame < motion.frames(); ++frame) {
    double bent_deg = 0.0;
    for (const contort_guest::Use& use : request.uses) {
      const double wave = std::sin(3.14159265358979 * use.progress(frame / request.rate_hz));
      bent_deg = std::max(bent_deg, wave * wave * use.params["angle_deg"].number);
    }
    motion.turn(frame, kElbow, {1, 0, 0}, -bent_deg);
  }
}

}  // namespace

int main() { return contort_guest::serve(kManifest, generate); }
