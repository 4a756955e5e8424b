#include "guest/frames.h"

#include <cmath>
#include <cstring>

#include "model/core/detmath.h"
#include "model/core/index.h"

namespace contort {

namespace {

std::size_t size_of(FrameFormat format) { return format == FrameFormat::f32 ? 4 : 8; }

// Reads one number after another. Frames are little-endian, like this machine.
class Numbers {
 public:
  Numbers(std::string_view bytes, FrameFormat format) : at_(bytes.data()), format_(format) {}
  double next() {
    if (format_ == FrameFormat::f64) return take<double>();
    return static_cast<double>(take<float>());
  }

 private:
  template <class T>
  T take() {
    T value;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  const char* at_;
  FrameFormat format_;
};

// A rotation as it was received, and the length of its quaternion.
struct RawRotation {
  Quat q = kNoRotation;
  double length = 1.0;
  bool is_zero() const { return length == 0.0; }
};

RawRotation next_rotation(Numbers& numbers, const Basis& basis) {
  const double x = numbers.next(), y = numbers.next(), z = numbers.next(), w = numbers.next();
  RawRotation raw;
  raw.length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!raw.is_zero()) raw.q = basis.rotation(x / raw.length, y / raw.length, z / raw.length, w / raw.length);
  return raw;
}

// The equivalent of `angle` nearest to `before`: a hinge may go beyond half a turn.
double unwrapped(double angle, double before) { return before + wrap_angle(angle - before); }

// The angle about the hinge's axis. The rest of the rotation goes to `off_axis_rad`.
double hinge_angle(const Joint& joint, const Quat& from_rest, double before, double& off_axis_rad) {
  const double along = glm::dot(Vec3(from_rest.x, from_rest.y, from_rest.z), joint.axis);
  const double angle = 2.0 * det::atan2(along, from_rest.w);
  off_axis_rad = rotation_angle(glm::conjugate(axis_angle(joint.axis, angle)) * from_rest);
  return unwrapped(angle, before);
}

// The angle of the previous frame; in the first frame the middle of the range, so that ranges beyond half a turn work.
double before_of(const Joint& joint, const Motion& motion, int frame) {
  return frame > 0 ? motion.row(frame - 1)[at(joint.coord)] : 0.5 * (joint.low + joint.high);
}

}  // namespace

void set_rotation(const Joint& joint, const Quat& in_parent, int frame, Motion& motion, double& off_axis_rad) {
  const Quat from_rest = glm::conjugate(joint.parent_from_joint.q) * in_parent;
  double* coord = motion.row(frame).data() + joint.coord;
  if (joint.kind == JointKind::ball) {
    coord[0] = from_rest.w, coord[1] = from_rest.x, coord[2] = from_rest.y, coord[3] = from_rest.z;
    return;
  }
  const double before = before_of(joint, motion, frame);
  coord[0] = hinge_angle(joint, from_rest, std::isfinite(before) ? before : 0.0, off_axis_rad);
}

std::size_t bytes_of(const FrameLayout& layout, int frames) {
  return at(frames) * (3 + 4 * layout.joints.size()) * size_of(layout.format);
}

void read_frames(std::string_view bytes, const FrameLayout& layout, int frames, Motion& motion, ForeignFacts& facts) {
  const std::span<const Joint> joints = layout.character.joints();
  motion.frame_count = frames;
  motion.coord_count = layout.character.coord_count();
  motion.coords.resize(at(frames) * at(motion.coord_count));
  motion.root.resize(at(frames));
  facts.quaternion_lengths.assign(at(frames) * joints.size(), 1.0);
  facts.off_axis_rad.assign(at(frames) * joints.size(), 0.0);
  Numbers numbers(bytes, layout.format);
  for (int frame = 0; frame < frames; ++frame) {
    const double x = numbers.next(), y = numbers.next(), z = numbers.next();
    motion.root[at(frame)].p_m = layout.basis.point_m(Vec3(x, y, z));
    for (const int j : layout.joints) {
      const RawRotation raw = next_rotation(numbers, layout.basis);
      const std::size_t place = at(frame) * joints.size() + at(j);
      facts.quaternion_lengths[place] = raw.length;
      if (j == 0)
        motion.root[at(frame)].q = raw.q;
      else
        set_rotation(joints[at(j)], raw.is_zero() ? joints[at(j)].parent_from_joint.q : raw.q, frame, motion,
                     facts.off_axis_rad[place]);
    }
  }
}

}  // namespace contort
