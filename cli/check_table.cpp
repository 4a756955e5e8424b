#include "cli/check_table.h"

#include <algorithm>

#include "checks/pop.h"
#include "guest/joint_values.h"
#include "model/core/files.h"

namespace contort::cli {

namespace {

ClipMotion motion_of_table(const ValuesMotion& made, const JointTable& table) {
  const Motion& motion = made.execution.motion;
  ClipMotion out;
  out.rate_hz = motion.rate_hz, out.first_s = table.times_s.front(), out.frames = motion.frame_count;
  out.joints = made.columns + static_cast<int>(made.computed.size());
  out.joint_count = static_cast<int>(made.execution.character->joints().size()) - 1;
  out.path = made.execution.path;
  out.stray_nodes = made.strange_columns, out.joints_at_rest = made.joints_at_rest;
  out.times_s = motion.times_s, out.columns = made.columns;
  out.column_count = static_cast<int>(table.columns.size());
  out.fixed_columns = made.fixed_columns, out.computed = made.computed, out.root_columns = made.root_columns;
  return out;
}

// Reads the joints of columns from a map that was written by hand, which has the same form as for nodes.
FileJoints joints_of_map(const JointMap& map) {
  FileJoints out = map.values;
  if (out.empty())
    for (const auto& [column, joint] : map.joints) out[column] = {.joint = joint};
  return out;
}

// Finds the greatest speed of joints that turn, as for the channels of a clip.
void find_peak(const Character& character, const Motion& motion, double first_s, ClipSpeeds& out) {
  const double begin_s = motion.times_s.empty() ? first_s : 0.0;
  for (const Joint& joint : character.joints().subspan(1))
    for (int frame = 1; frame < motion.frame_count && joint.kind == JointKind::hinge; ++frame) {
      const double speed = speed_into(motion, joint, frame);
      out.least_margin_rad_s = std::min(out.least_margin_rad_s, joint.max_speed - speed);
      if (speed <= out.peak_rad_s) continue;
      out.peak_node = joint.name, out.peak_rad_s = speed;
      out.peak_t0_s = begin_s + motion.time_s(frame - 1), out.peak_t1_s = begin_s + motion.time_s(frame);
    }
}

}  // namespace

Result<ClipReport> check_table(const TableCheck& in, Judge& judge) {
  const JointTable& table = *in.animation.table;
  if (!in.on.character)
    return Issue{"check.needs_character", "",
                 in.file + " has values of joints without a skeleton; --character NAME says whose they are"};
  const FileJoints joints = joints_of_map(in.on.map);
  const auto& [x, y, z, w] = in.on.map.root_rotation;
  const Result<ValuesMotion> made = motion_of_values(
      {table, in.on.character, joints, in.options.unit == "deg", in.options.up == "y", normalize(Quat(w, x, y, z))});
  if (!made) return about_file(in.file, made.issue());
  if (!in.options.up.empty() && made->root_columns.empty())
    return Issue{"usage.no_root", "", "--up has no effect on " + in.file + ", which does not say where the root is"};
  const AssetClip& clip = in.animation.asset.clips.front();
  ClipReport report;
  report.file = in.file;
  report.judged = judge_clip({in.animation.asset, clip, in.limits.settings, false, std::nullopt}, in.limits, nullptr);
  add_motion(judge.evaluate(made->execution), {}, report.judged);
  report.judged.channels = made->columns;
  report.judged.channel_count = static_cast<int>(table.columns.size());
  find_peak(*in.on.character, made->execution.motion, table.times_s.front(), report.judged.speeds);
  report.motion = motion_of_table(*made, table);
  report.made = made->execution;
  return report;
}

}  // namespace contort::cli
