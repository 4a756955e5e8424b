#include "formats/robot/mjcf_geom.h"

#include <cmath>
#include <filesystem>

#include "formats/robot/shapes.h"

namespace contort {

namespace {

enum class Solid { sphere, capsule, cylinder, ellipsoid, box };

// A solid with its axis along +Z; half sizes, or radius and half the length of the straight part.
struct MeasuredSolid {
  Solid kind = Solid::sphere;
  Vec3 size_m{0.0};
  Rigid at;
};

double volume_m3(const MeasuredSolid& s) {
  const double r = s.size_m.x, h = 2.0 * s.size_m.y;
  switch (s.kind) {
    case Solid::sphere: return 4.0 / 3.0 * kPi * r * r * r;
    case Solid::capsule: return kPi * r * r * (h + 4.0 / 3.0 * r);
    case Solid::cylinder: return kPi * r * r * h;
    case Solid::ellipsoid: return 4.0 / 3.0 * kPi * s.size_m.x * s.size_m.y * s.size_m.z;
    case Solid::box: return 8.0 * s.size_m.x * s.size_m.y * s.size_m.z;
  }
  return 0.0;
}

// Principal moments of a solid of 1 kg about its middle.
Vec3 unit_moments(const MeasuredSolid& s) {
  const double r = s.size_m.x, h = 2.0 * s.size_m.y;
  const Vec3 sq = s.size_m * s.size_m;
  switch (s.kind) {
    case Solid::sphere: return Vec3(0.4 * r * r);
    case Solid::cylinder: return {(3.0 * r * r + h * h) / 12.0, (3.0 * r * r + h * h) / 12.0, 0.5 * r * r};
    case Solid::ellipsoid: return Vec3(sq.y + sq.z, sq.x + sq.z, sq.x + sq.y) / 5.0;
    case Solid::box: return Vec3(sq.y + sq.z, sq.x + sq.z, sq.x + sq.y) / 3.0;
    case Solid::capsule: break;
  }
  // A cylinder, and two half balls whose own middles are 3/8 r from their flat sides.
  const double whole = h + 4.0 / 3.0 * r, tube = h / whole, caps = 1.0 - tube;
  const double across = tube * (3.0 * r * r + h * h) / 12.0 + caps * (0.4 * r * r + 0.25 * h * h + 0.375 * h * r);
  return {across, across, tube * 0.5 * r * r + caps * 0.4 * r * r};
}

std::optional<Solid> solid_named(const std::string& type) {
  if (type == "sphere") return Solid::sphere;
  if (type == "capsule") return Solid::capsule;
  if (type == "cylinder") return Solid::cylinder;
  if (type == "ellipsoid") return Solid::ellipsoid;
  if (type == "box") return Solid::box;
  return {};
}

ColliderShape shape_of(const MeasuredSolid& s) {
  switch (s.kind) {
    case Solid::sphere: return Sphere{s.at.p_m, s.size_m.x};
    case Solid::capsule: return placed_capsule(s.at, s.size_m.x, s.size_m.y);
    case Solid::cylinder: return placed_cylinder(s.at, s.size_m.x, s.size_m.y);
    case Solid::ellipsoid: return placed_ellipsoid(s.at, s.size_m);
    case Solid::box: return placed_box(s.at, s.size_m);
  }
  return Sphere{};
}

MeasuredSolid measure(MjcfText& text, const XmlElement& element, const MjcfAttributes& given, Solid kind) {
  MeasuredSolid out{kind, Vec3(0.0), text.pose(element, given)};
  if (const auto size = text.numbers(element, given, "size", 1, 3))
    for (std::size_t i = 0; i < size->size(); ++i) out.size_m[static_cast<int>(i)] = (*size)[i];
  if (const auto ends = text.numbers(element, given, "fromto", 6, 6)) {
    const Vec3 a((*ends)[0], (*ends)[1], (*ends)[2]), b((*ends)[3], (*ends)[4], (*ends)[5]);
    out.at = {shortest_arc(Vec3(0, 0, 1), unit_or(b - a, Vec3(0, 0, 1))), 0.5 * (a + b)};
    const double half_m = 0.5 * length(b - a);
    out.size_m = kind == Solid::box || kind == Solid::ellipsoid ? Vec3(out.size_m.x, out.size_m.x, half_m)
                                                                : Vec3(out.size_m.x, half_m, 0.0);
  }
  return out;
}

unsigned bits(MjcfText& text, const XmlElement& element, const MjcfAttributes& given, const char* attribute) {
  const double value = text.number(element, given, attribute, 1.0);
  return value >= 0.0 && value < 4294967296.0 ? static_cast<unsigned>(value) : 0U;
}

RobotShape mesh_shape(MjcfText& text, const XmlElement& element, const MjcfAttributes& given, const MjcfMeshes& all) {
  RobotShape out;
  out.body_from_mesh = text.pose(element, given);
  const auto found = all.find(value_of(given, "mesh"));
  if (found == all.end()) {
    text.faults.fail("unknown_mesh", element, "there is no mesh " + quoted_name(value_of(given, "mesh")));
    return out;
  }
  out.mesh = found->second.file;
  out.mesh_scale = found->second.scale;
  return out;
}

void add_mass(MjcfText& text, const XmlElement& element, const MjcfAttributes& given, const MeasuredSolid& solid,
              MjcfGeom& out) {
  const double density = text.number(element, given, "density", 1000.0);
  const double mass_kg = text.number(element, given, "mass", density * volume_m3(solid));
  if (mass_kg < 0.0) text.faults.fail("bad_mass", element, "a mass is negative");
  if (!(mass_kg > 0.0)) return;
  out.inertia = moved(solid.at, principal_inertia(mass_kg, Vec3(0.0), mass_kg * unit_moments(solid)));
}

}  // namespace

MjcfMeshes read_meshes(MjcfText& text, const XmlElement& root) {
  MjcfMeshes out;
  for (const XmlElement* asset : elements_of(root, "asset"))
    for (const XmlElement* mesh : elements_of(*asset, "mesh")) {
      const MjcfAttributes given = text.attributes(*mesh, "");
      const std::string file = value_of(given, "file");
      std::string name = value_of(given, "name");
      if (name.empty()) name = std::filesystem::path(file).stem().string();
      const std::string& folder = text.settings().mesh_folder;
      out[name] = {file.empty() || folder.empty() ? file : folder + "/" + file,
                   text.vector(*mesh, given, "scale", Vec3(1.0))};
    }
  return out;
}

MjcfGeom read_geom(MjcfText& text, const XmlElement& element, const MjcfAttributes& given, const MjcfMeshes& meshes) {
  MjcfGeom out;
  const std::string type = value_of(given, "type").empty() ? "sphere" : value_of(given, "type");
  const std::optional<Solid> solid = solid_named(type);
  const unsigned groups = bits(text, element, given, "contype"), partners = bits(text, element, given, "conaffinity");
  const bool touches = groups != 0 || partners != 0;
  const double group = text.number(element, given, "group", 0.0);
  const bool weighs = group >= text.settings().inertia_groups[0] && group <= text.settings().inertia_groups[1];
  if (type == "mesh" || (solid && !value_of(given, "mesh").empty())) {
    out.has_unknown_mass = weighs && text.number(element, given, "density", 1000.0) > 0.0 &&
                           text.number(element, given, "mass", 1.0) > 0.0;
    if (touches) out.shape = mesh_shape(text, element, given, meshes);
  } else if (solid) {
    const MeasuredSolid measured = measure(text, element, given, *solid);
    if (weighs) add_mass(text, element, given, measured, out);
    if (touches && is_solid(shape_of(measured)))
      out.shape = RobotShape{.shape = shape_of(measured), .mesh = "", .body_from_mesh = {}};
  } else {
    out.left_out = type;
  }
  if (out.shape) out.shape->groups = groups, out.shape->partners = partners;
  return out;
}

BodyInertia read_inertial(MjcfText& text, const XmlElement& element) {
  const MjcfAttributes given = attributes_of(element);
  BodyInertia out;
  out.mass_kg = text.number(element, given, "mass", 0.0);
  if (out.mass_kg < 0.0) text.faults.fail("bad_mass", element, "a mass is negative");
  if (const auto i = text.numbers(element, given, "fullinertia", 6, 6))
    out.inertia_kg_m2 = Mat3((*i)[0], (*i)[3], (*i)[4], (*i)[3], (*i)[1], (*i)[5], (*i)[4], (*i)[5], (*i)[2]);
  const Vec3 principal = text.vector(element, given, "diaginertia", Vec3(0.0));
  if (!given.contains("fullinertia")) out = principal_inertia(out.mass_kg, Vec3(0.0), principal);
  return out.mass_kg > 0.0 ? moved(text.pose(element, given), out) : BodyInertia{};
}

}  // namespace contort
