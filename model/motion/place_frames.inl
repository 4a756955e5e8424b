// Forward kinematics of several frames at once, for one type of `Lanes` (see place_frames.cpp, which includes this for
// each): lane i of every number belongs to frame first + i. The operations are those of forward_kinematics in their
// order (glm's products of quaternions and with a vector), so that the bits are the same.

inline constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(double);

struct Points {
  Lanes x, y, z;
};
struct Turns {
  Lanes w, x, y, z;
};
struct alignas(32) Places {
  Turns q;
  Points p;
};

inline Points spread(const Vec3& v) { return {Lanes{} + v.x, Lanes{} + v.y, Lanes{} + v.z}; }
inline Turns spread(const Quat& q) { return {Lanes{} + q.w, Lanes{} + q.x, Lanes{} + q.y, Lanes{} + q.z}; }

inline Points operator+(const Points& a, const Points& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Points cross(const Points& a, const Points& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
inline Points operator*(const Turns& q, const Points& v) {
  const Points axis = {q.x, q.y, q.z};
  const Points uv = cross(axis, v), uuv = cross(axis, uv);
  return {v.x + (uv.x * q.w + uuv.x) * 2.0, v.y + (uv.y * q.w + uuv.y) * 2.0, v.z + (uv.z * q.w + uuv.z) * 2.0};
}
inline Turns operator*(const Turns& p, const Turns& q) {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z, p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x};
}
inline Places operator*(const Places& a, const Places& b) { return {a.q * b.q, a.p + a.q * b.p}; }

// Number i of each of the frames, which are `stride` numbers apart.
inline Lanes gather(const double* first, std::size_t stride) {
  Lanes out{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) out[lane] = first[lane * stride];
  return out;
}

inline Turns hinge_turns(const Vec3& axis, const double* coord, std::size_t stride) {
  double halves[kLanes];
  det::SinCos turns[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) halves[lane] = 0.5 * coord[lane * stride];
  det::sincos(halves, turns);
  Lanes sin{}, cos{};
  for (std::size_t lane = 0; lane < kLanes; ++lane) sin[lane] = turns[lane].sin, cos[lane] = turns[lane].cos;
  return {cos, sin * axis.x, sin * axis.y, sin * axis.z};
}

inline void move(const Joint& joint, const double* coord, std::size_t stride, Places& own) {
  switch (joint.kind) {
    case JointKind::hinge: own.q = own.q * hinge_turns(joint.axis, coord, stride); break;
    case JointKind::ball:
      own.q = own.q * Turns{gather(coord, stride), gather(coord + 1, stride), gather(coord + 2, stride),
                            gather(coord + 3, stride)};
      break;
    case JointKind::prismatic: {
      const Lanes travel = gather(coord, stride);
      own.p = own.p + own.q * Points{travel * joint.axis.x, travel * joint.axis.y, travel * joint.axis.z};
      break;
    }
    case JointKind::root: break;
  }
}

inline void scatter(const Places& places, std::size_t joints, Rigid* first) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto& [q, p] = places;
    first[lane * joints] = {Quat(q.w[lane], q.x[lane], q.y[lane], q.z[lane]), Vec3(p.x[lane], p.y[lane], p.z[lane])};
  }
}

inline Places gather_roots(const Rigid* roots) {
  Places out;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto& [q, p] = roots[lane];
    out.q.w[lane] = q.w, out.q.x[lane] = q.x, out.q.y[lane] = q.y, out.q.z[lane] = q.z;
    out.p.x[lane] = p.x, out.p.y[lane] = p.y, out.p.z[lane] = p.z;
  }
  return out;
}

inline void place_few(const Character& character, const Motion& motion, std::size_t frame, std::vector<Places>& places,
                      Rigid* world) {
  const std::span<const Joint> joints = character.joints();
  const auto stride = static_cast<std::size_t>(motion.coord_count);
  const double* rows = motion.coords.data() + frame * stride;
  places[0] = gather_roots(&motion.root[frame]);
  scatter(places[0], joints.size(), world);
  for (std::size_t j = 1; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    const Places rest = {spread(joint.parent_from_joint.q), spread(joint.parent_from_joint.p_m)};
    places[j] = places[static_cast<std::size_t>(joint.parent)] * rest;
    move(joint, rows + joint.coord, stride, places[j]);
    scatter(places[j], joints.size(), world + j);
  }
}

inline std::size_t place_whole(const Character& character, const Motion& motion, Rigid* world) {
  const std::size_t joints = character.joints().size(), frames = static_cast<std::size_t>(motion.frame_count);
  std::vector<Places> places(joints);
  std::size_t frame = 0;
  for (; frame + kLanes <= frames; frame += kLanes) place_few(character, motion, frame, places, world + frame * joints);
  return frame;
}
