// Prints the table of docs/experiments/squat: each spec with tracking and with dynamic control.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "generator/generate.h"
#include "model/core/files.h"

namespace contort {

namespace {

struct Numbers {
  double lumbar_Nm = 0.0, hip_Nm = 0.0, knee_Nm = 0.0;  // greatest efforts
  double zmp_low_m = 1e9, zmp_high_m = -1e9;            // along the feet, from the ankles
  int outside = 0;                                      // number of frames
  double arms_deg = 0.0, lumbar_deg = 0.0;              // greatest distance forward of the target
};

double degrees_off(const Joint& joint, const double* now, const double* goal) {
  if (joint.kind != JointKind::ball) return (now[0] - goal[0]) * kDegPerRad;
  const Quat a(now[0], now[1], now[2], now[3]), b(goal[0], goal[1], goal[2], goal[3]);
  return -to_rotation_vector(a * glm::conjugate(b)).x * kDegPerRad;
}

void add_joint(const Joint& joint, const Link& link, const Motion& motion, int frame, Numbers& out) {
  const Response& response = motion.response;
  const std::size_t row = static_cast<std::size_t>(frame), coord = static_cast<std::size_t>(joint.coord);
  const double effort = std::fabs(
      response.efforts[row * static_cast<std::size_t>(response.dof_count) + static_cast<std::size_t>(link.dof)]);
  if (joint.local_name == "lumbar_flex") out.lumbar_Nm = std::max(out.lumbar_Nm, effort);
  if (joint.local_name == "hip_flex") out.hip_Nm = std::max(out.hip_Nm, effort);
  if (joint.local_name == "knee") out.knee_Nm = std::max(out.knee_Nm, effort);
  const std::size_t at = row * static_cast<std::size_t>(motion.coord_count) + coord;
  const double off = degrees_off(joint, &motion.coords[at], &response.target_coords[at]);
  if (joint.local_name == "shoulder") out.arms_deg = std::max(out.arms_deg, off);
  if (joint.local_name == "lumbar_flex") out.lumbar_deg = std::max(out.lumbar_deg, off);
}

Numbers measured(const Spec& spec, const Library& library) {
  const Result<Stage> stage = build_stage(spec, library);
  const Motion motion = generate(*stage);
  Numbers out;
  for (int f = 0; f < motion.frame_count; ++f) {
    for (std::size_t j = 1; j < stage->character->joints().size(); ++j)
      add_joint(stage->character->joints()[j], stage->dynamics->figure.body.links()[j], motion, f, out);
    const Stance& stance = motion.response.stances[static_cast<std::size_t>(f)];
    const double zmp_m = stance.zmp_m.z + spec.start.ahead_m;
    out.zmp_low_m = std::min(out.zmp_low_m, zmp_m), out.zmp_high_m = std::max(out.zmp_high_m, zmp_m);
    out.outside += stance.margin_m < 0.0 || stance.footing != Footing::standing;
  }
  return out;
}

void print_row(const char* name, const Numbers& t, const Numbers& d) {
  std::printf(
      "| %s | %.1f → %.1f | %.1f → %.1f | %.1f → %.1f | [%.3f, %.3f] → [%.3f, %.3f] | %d → %d | %+.1f | %+.1f |\n",
      name, t.lumbar_Nm, d.lumbar_Nm, t.hip_Nm, d.hip_Nm, t.knee_Nm, d.knee_Nm, t.zmp_low_m, t.zmp_high_m, d.zmp_low_m,
      d.zmp_high_m, t.outside, d.outside, d.arms_deg, d.lumbar_deg);
}

int run(const std::string& folder) {
  Library library = stock_library();
  if (const Result<Done> loaded = load_folder(folder + "/actions", library); !loaded) {
    std::fprintf(stderr, "%s\n", to_line(loaded.issue()).c_str());
    return 2;
  }
  std::puts("| case | waist N m | hip N m | knee N m | ZMP from the ankles m | frames outside | arms ° | waist ° |");
  std::puts("|---|---|---|---|---|---|---|---|");
  for (const char* name : {"a_nothing_added", "b_5_kg", "c_8_kg", "d_blow"}) {
    const Result<std::string> text = read_file(folder + "/" + name + ".json");
    const Result<Spec> spec = text ? parse_spec(*text) : Result<Spec>(text.issue());
    if (!spec) {
      std::fprintf(stderr, "%s: %s\n", name, to_line(spec.issue()).c_str());
      return 2;
    }
    Spec tracked = *spec;
    tracked.dynamics.mode = Mode::tracking;
    print_row(name, measured(tracked, library), measured(*spec, library));
  }
  return 0;
}

}  // namespace

}  // namespace contort

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: contort_squat_table FOLDER\n", stderr);
    return 2;
  }
  return contort::run(argv[1]);
}
