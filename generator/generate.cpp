#include "generator/generate.h"

#include <algorithm>

#include "generator/motion/kinematics.h"

namespace contort {

namespace {

bool moves_at(const PlannedAction& action, int frame) {
  return frame >= action.first_frame && frame <= action.last_frame;
}

// Whether `next` takes the part from `held`: the higher layer, then the later start, then the later in the spec. In the
// frame of its start an action has not moved anything yet, and leaves the part to one that is just arriving.
bool outranks(const PlannedAction& next, const PlannedAction& held, int frame) {
  if ((next.start < frame) != (held.start < frame)) return next.start < frame;
  if (next.def->layer != held.def->layer) return next.def->layer > held.def->layer;
  return next.start >= held.start;
}

int winner(const Timeline& timeline, std::size_t part, int frame) {
  int best = -1;
  for (const int index : timeline.of_part[part]) {
    const PlannedAction& action = timeline.actions[static_cast<std::size_t>(index)];
    if (!moves_at(action, frame)) continue;
    if (best < 0 || outranks(action, timeline.actions[static_cast<std::size_t>(best)], frame)) best = index;
  }
  return best;
}

// row = from blended to target, joint by joint: balls along the shorter arc, the rest linearly.
void blend_part(const Character& character, const Part& part, const double* from, const double* target, double weight,
                double* row) {
  for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j) {
    const Joint& joint = character.joints()[static_cast<std::size_t>(j)];
    const double* a = from + joint.coord;
    const double* b = target + joint.coord;
    double* out = row + joint.coord;
    if (joint.kind == JointKind::ball) {
      const Quat q = slerp_short(Quat(a[0], a[1], a[2], a[3]), Quat(b[0], b[1], b[2], b[3]), weight);
      out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
    } else {
      out[0] = a[0] + (b[0] - a[0]) * weight;
    }
  }
}

class Generation {
 public:
  Generation(const Stage& stage, GenerateScratch& scratch, Motion& motion)
      : stage_(stage), character_(*stage.character), scratch_(scratch), motion_(motion) {}

  void run() {
    prepare();
    for (int frame = 0; frame < stage_.frame_count; ++frame) make_frame(frame);
  }

 private:
  void prepare() {
    const auto frames = static_cast<std::size_t>(stage_.frame_count);
    const auto coords = static_cast<std::size_t>(character_.coord_count());
    motion_.rate_hz = stage_.rate_hz;
    motion_.frame_count = stage_.frame_count;
    motion_.coord_count = character_.coord_count();
    motion_.coords.resize(frames * coords);
    motion_.root.assign(frames, character_.rest_root());
    motion_.spans.clear();
    scratch_.control.assign(character_.parts().size(), {});
    scratch_.from.resize(coords);
    scratch_.target.resize(coords);
    scratch_.world.resize(character_.joints().size());
  }

  void make_frame(int frame) {
    const std::span<double> row = motion_.row(frame);
    const std::span<const double> before =
        frame == 0 ? character_.rest_coords() : std::span<const double>(motion_.row(frame - 1));
    std::copy(before.begin(), before.end(), row.begin());
    scratch_.world[0] = motion_.root[static_cast<std::size_t>(frame)];
    const std::span<const Part> parts = character_.parts();
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const int action = winner(stage_.timeline, p, frame);
      hand_over(p, action, frame, row);
      if (action >= 0) move_part(parts[p], scratch_.control[p], frame, row);
      forward_kinematics(character_, row, parts[p].first_joint, parts[p].first_joint + parts[p].joint_count,
                         scratch_.world);
    }
  }

  // When another action takes the part, remembers the posture that it starts from, and notes the span.
  void hand_over(std::size_t p, int action, int frame, std::span<const double> row) {
    GenerateScratch::Control& control = scratch_.control[p];
    if (action >= 0 && action != control.action) {
      const PlannedAction& planned = stage_.timeline.actions[static_cast<std::size_t>(action)];
      const Part& part = character_.parts()[p];
      std::copy_n(row.begin() + part.first_coord, part.coord_count, scratch_.from.begin() + part.first_coord);
      control.eased_at_gain = ease(progress(planned, frame - 1));
      control.span = static_cast<int>(motion_.spans.size());
      motion_.spans.push_back({frame, frame, planned.sequence, planned.clip, planned.action});
    }
    control.action = action;
    if (action >= 0) motion_.spans[static_cast<std::size_t>(control.span)].last_frame = frame;
  }

  void move_part(const Part& part, const GenerateScratch::Control& control, int frame, std::span<double> row) {
    const PlannedAction& action = stage_.timeline.actions[static_cast<std::size_t>(control.action)];
    std::copy_n(scratch_.from.begin() + part.first_coord, part.coord_count, scratch_.target.begin() + part.first_coord);
    // A chain may hang on a joint of its own part.
    if (action.def->layer == Layer::ik)
      forward_kinematics(character_, scratch_.target, part.first_joint, part.first_joint + part.joint_count,
                         scratch_.world);
    action.def->rule({character_, part, action.params, scratch_.world}, scratch_.target);
    const double eased = ease(progress(action, frame));
    const double left = 1.0 - control.eased_at_gain;
    const double weight = left > 1e-9 ? (eased - control.eased_at_gain) / left : 1.0;
    blend_part(character_, part, scratch_.from.data(), scratch_.target.data(), weight, row.data());
  }

  const Stage& stage_;
  const Character& character_;
  GenerateScratch& scratch_;
  Motion& motion_;
};

}  // namespace

void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion) {
  Generation(stage, scratch, motion).run();
}

Motion generate(const Stage& stage) {
  GenerateScratch scratch;
  Motion motion;
  generate(stage, scratch, motion);
  return motion;
}

}  // namespace contort
