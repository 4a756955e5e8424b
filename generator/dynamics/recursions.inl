// The recursions over a tree, for one type of `Vector` (see recursions.cpp, which includes this for each). Every sum
// has the same terms in the same order for all of them, so that the bits are the same.

// z first: one exchange less.
inline Vector cross(const Vector& a, const Vector& b) { return yzx(a * yzx(b) - yzx(a) * b); }

// SpatialMotion and SpatialForce while they are worked on.
struct Twist {
  Vector angular, linear;
};
struct Wrench {
  Vector moment, force;
};

inline Twist load(const SpatialMotion& m) { return {load(m.angular), load(m.linear)}; }
inline Wrench load(const SpatialForce& f) { return {load(f.moment), load(f.force)}; }
inline void store(const Twist& m, SpatialMotion& out) { store(m.angular, out.angular), store(m.linear, out.linear); }
inline void store(const Wrench& f, SpatialForce& out) { store(f.moment, out.moment), store(f.force, out.force); }
inline Twist operator+(const Twist& a, const Twist& b) { return {a.angular + b.angular, a.linear + b.linear}; }
inline Wrench operator+(const Wrench& a, const Wrench& b) { return {a.moment + b.moment, a.force + b.force}; }
inline Twist operator*(double share, const Twist& m) { return {share * m.angular, share * m.linear}; }
inline double dot(const Twist& m, const Wrench& f) { return dot(m.angular, f.moment) + dot(m.linear, f.force); }

// M v by columns.
inline Vector product(const WideMat3& m, const Vec3& v) {
  return v.x * load(m[0]) + v.y * load(m[1]) + v.z * load(m[2]);
}

// Stores the motion of a rotation about an axis through a link's origin, relative to the root's origin.
inline void put_turning(const Vector& axis, const Vector& origin_m, SpatialMotion& out) {
  store(axis, out.angular);
  store(cross(origin_m, axis), out.linear);
}

// A hinge about its frame's axis k turns the other two columns.
inline void turn_columns(int k, double sin, double cos, const WideMat3& from, WideMat3& to) {
  constexpr static int kAxes[] = {0, 1, 2, 0, 1};
  const int i = kAxes[k + 1], j = kAxes[k + 2];
  const Vector first = load(from[i]), second = load(from[j]);
  store(load(from[k]), to[k]);
  store(cos * first + sin * second, to[i]);
  store(cos * second - sin * first, to[j]);
}

// Rodrigues' formula, about any unit vector.
inline void turn_about(const Vector& axis, double sin, double cos, const WideMat3& from, WideMat3& to) {
  for (int k = 0; k < 3; ++k) {
    const Vector column = load(from[k]);
    store(cos * column + sin * cross(axis, column) + ((1.0 - cos) * dot(axis, column)) * axis, to[k]);
  }
}

// Turns a hinge's frame from where it rests; its axis in the world.
inline Vector turn_hinge(const Link& link, const Placement& parent, const det::SinCos& turn, const WideMat3& from,
                         WideMat3& to) {
  if (link.turns_about >= 0) {
    turn_columns(link.turns_about, link.sense * turn.sin, turn.cos, from, to);
    return link.sense * load(to[link.turns_about]);
  }
  const Vector axis = product(parent.rotation, link.axis);
  turn_about(axis, turn.sin, turn.cos, from, to);
  return axis;
}

inline void put_product(const WideMat3& a, const Mat3& b, WideMat3& out) {
  const Vector columns[] = {product(a, b[0]), product(a, b[1]), product(a, b[2])};
  for (int k = 0; k < 3; ++k) store(columns[k], out[k]);
}

// Places a link, with the unit rates of its freedoms. A ball's are along the axes of the body that it moves.
inline void place_link(const Link& link, const Placement& parent, const Vector& root_m, const double* q,
                       const det::SinCos& turn, Placement& own, SpatialMotion* freedoms) {
  const Vector origin_m = load(parent.origin_m) + product(parent.rotation, link.origin_m);
  store(origin_m, own.origin_m);
  if (!link.is_straight) put_product(parent.rotation, link.rest, own.rotation);
  const WideMat3& from = link.is_straight ? parent.rotation : own.rotation;
  if (link.kind == JointKind::hinge) {
    put_turning(turn_hinge(link, parent, turn, from, own.rotation), origin_m - root_m, freedoms[0]);
  } else if (link.kind == JointKind::prismatic) {
    if (link.is_straight) own.rotation = from;
    const Vector along = product(parent.rotation, link.axis);
    freedoms[0].angular = Vec3(0.0);
    store(along, freedoms[0].linear);
    store(origin_m + q[0] * along, own.origin_m);
  } else {
    put_product(from, glm::mat3_cast(Quat(q[0], q[1], q[2], q[3])), own.rotation);
    for (int k = 0; k < 3; ++k) put_turning(load(own.rotation[k]), origin_m - root_m, freedoms[k]);
  }
}

// Inertia about the centre of mass turned, then moved: (R L) (R L)^T + m (c.c 1 - c c^T), c from the root. It is
// computed as its diagonal and what stands at yz, xz and xy.
inline void place_inertia(double mass_kg, const Vec3& center_of_mass_m, const Mat3& root, const Placement& link,
                          const Vector& root_m, SpatialInertia& out) {
  const Vector c = (load(link.origin_m) - root_m) + product(link.rotation, center_of_mass_m);
  const Vector moment = mass_kg * c;
  const Vector square = moment * c;
  const Vector y = load(link.rotation[1]), z = load(link.rotation[2]);
  const Vector u = root[0].x * load(link.rotation[0]) + root[0].y * y + root[0].z * z;
  const Vector v = root[1].y * y + root[1].z * z;
  const Vector w = root[2].z * z;
  out.mass_kg = mass_kg;
  store(moment, out.first_moment);
  const Vector diagonal = u * u + v * v + w * w + (yxx(square) + zzy(square));
  const Vector beside = yxx(u) * zzy(u) + yxx(v) * zzy(v) + yxx(w) * zzy(w) - yxx(moment) * zzy(c);
  put_symmetric(diagonal, beside, out.inertia);
}

// A link moves as its parent does, and as its own freedoms.
inline void add_joint(const Link& link, const double* velocity, const double* acceleration, std::size_t i,
                      DynamicsScratch& scratch) {
  const std::size_t first = at(link.dof), parent = at(link.parent);
  const Twist freedom = load(scratch.freedoms[first]);
  Twist rate = velocity[first] * freedom;
  Twist change = acceleration[first] * freedom;
  for (std::size_t k = first + 1; k < first + at(link.dof_count); ++k) {
    const Twist next = load(scratch.freedoms[k]);
    rate = rate + velocity[k] * next, change = change + acceleration[k] * next;
  }
  const Twist v = load(scratch.velocity[parent]) + rate;
  store(v, scratch.velocity[i]);
  const Twist carried{cross(v.angular, rate.angular), cross(v.angular, rate.linear) + cross(v.linear, rate.angular)};
  store(load(scratch.acceleration[parent]) + change + carried, scratch.acceleration[i]);
}

// Computes the same as force_of().
inline void put_force(const SpatialInertia& i, const SpatialMotion& motion, const SpatialMotion& change,
                      SpatialForce& out) {
  const Twist v = load(motion), a = load(change);
  const Vector first_moment = load(i.first_moment);
  const Vector origin_m_s2 = a.linear + cross(v.angular, v.linear);
  store(i.mass_kg * origin_m_s2 + cross(a.angular, first_moment) + cross(v.angular, cross(v.angular, first_moment)),
        out.force);
  store(product(i.inertia, change.angular) + cross(v.angular, product(i.inertia, motion.angular)) +
            cross(first_moment, origin_m_s2),
        out.moment);
}

inline Wrench product(const SpatialInertia& i, const SpatialMotion& m) {
  const Vector first_moment = load(i.first_moment), angular = load(m.angular), linear = load(m.linear);
  return {product(i.inertia, m.angular) + cross(first_moment, linear),
          i.mass_kg * linear - cross(first_moment, angular)};
}

inline void add(const SpatialInertia& more, SpatialInertia& sum) {
  sum.mass_kg += more.mass_kg;
  store(load(sum.first_moment) + load(more.first_moment), sum.first_moment);
  for (int k = 0; k < 3; ++k) store(load(sum.inertia[k]) + load(more.inertia[k]), sum.inertia[k]);
}

void place_links(const Multibody& body, std::span<const double> coords, DynamicsScratch& scratch) {
  const auto links = body.links();
  const Vector root_m = load(scratch.world[0].origin_m);
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = links[i];
    place_link(link, scratch.world[at(link.parent)], root_m, &coords[at(link.coord)], scratch.turns[i],
               scratch.world[i], &scratch.freedoms[at(link.dof)]);
  }
  for (std::size_t i = 0; i < links.size(); ++i)
    if (const Link& link = links[i]; !link.massless)
      place_inertia(link.mass_kg, link.center_of_mass_m, link.inertia_root, scratch.world[i], root_m,
                    scratch.inertia[i]);
}

void place_mass(double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_root, const Placement& link,
                const Vec3& root_m, SpatialInertia& out) {
  place_inertia(mass_kg, center_of_mass_m, inertia_root, link, load(WideVec3(root_m)), out);
}

void sum_forces(const Multibody& body, std::span<const double> velocity, std::span<const double> acceleration,
                DynamicsScratch& scratch, std::span<double> forces) {
  const auto links = body.links();
  for (std::size_t i = 1; i < links.size(); ++i) add_joint(links[i], velocity.data(), acceleration.data(), i, scratch);
  for (std::size_t i = 0; i < links.size(); ++i)
    if (links[i].massless)
      scratch.force[i] = {};
    else
      put_force(scratch.inertia[i], scratch.velocity[i], scratch.acceleration[i], scratch.force[i]);
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    const Wrench force = load(scratch.force[i]);
    for (std::size_t k = at(link.dof); k < at(link.dof + link.dof_count); ++k)
      forces[k] = dot(load(scratch.freedoms[k]), force);
    if (i > 0) store(load(scratch.force[at(link.parent)]) + force, scratch.force[at(link.parent)]);
  }
}

void fill_mass_matrix(const Multibody& body, DynamicsScratch& scratch, std::span<double> matrix) {
  const auto links = body.links();
  const int* parent_dof = body.parent_dof().data();
  const auto n = at(body.dof_count());
  const WideMat3& root = scratch.world[0].rotation;
  const SpatialMotion* freedoms = scratch.freedoms.data();
  for (std::size_t i = 0; i < links.size(); ++i)
    scratch.composite[i] = links[i].massless ? SpatialInertia{} : scratch.inertia[i];
  for (std::size_t i = links.size(); i-- > 1;) {
    const Link& link = links[i];
    for (int k = link.dof; k < link.dof + link.dof_count; ++k) {
      const Wrench force = product(scratch.composite[i], freedoms[k]);
      double* row = &matrix[at(k) * n];
      for (int j = k; j >= kRootDofs; j = parent_dof[j])
        matrix[at(j) * n + at(k)] = row[j] = dot(load(freedoms[j]), force);
      for (int j = 0; j < 3; ++j) row[j] = force.force[j], row[3 + j] = dot(load(root[j]), force.moment);
      for (std::size_t j = 0; j < kRootDofs; ++j) matrix[j * n + at(k)] = row[j];
    }
    add(scratch.composite[i], scratch.composite[at(link.parent)]);
  }
  for (int k = 0; k < kRootDofs; ++k) {
    const Wrench force = product(scratch.composite[0], freedoms[k]);
    for (int j = 0; j <= k; ++j) matrix[at(j) * n + at(k)] = matrix[at(k) * n + at(j)] = dot(load(freedoms[j]), force);
  }
}

void multiply(std::span<const double> matrix, std::span<const double> x, std::span<double> out) {
  std::ranges::fill(out, 0.0);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k] != 0.0) add_row(x[k], &matrix[k * x.size()], x.size(), out.data());
}
