#include "renders/scene_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "renders/ground.h"

namespace contort::scene {

constexpr double kGroundBeyond_m = 2.0;  // distance around the figure's path to which the ground is shown

// Rounds to a millionth, which is far below what is visible; null for values that JSON cannot express.
Json number(double value) { return std::isfinite(value) ? Json(std::round(value * 1e6) / 1e6 + 0.0) : Json(); }
Json vector(const Vec3& v) { return {number(v.x), number(v.y), number(v.z)}; }
namespace {

Json quaternion(const Quat& q) { return {number(q.x), number(q.y), number(q.z), number(q.w)}; }

// ---- solids

Json shape_json(const Sphere& s, const Rigid& place) {
  return {{"shape", "sphere"}, {"center", vector(place * s.center_m)}, {"radius", number(s.radius_m)}};
}

Json shape_json(const Capsule& c, const Rigid& place) {
  return {{"shape", "capsule"},
          {"a", vector(place * c.a_m)},
          {"b", vector(place * c.b_m)},
          {"radius", number(c.radius_m)}};
}

Json shape_json(const Box& b, const Rigid& place) {
  return {{"shape", "box"},
          {"center", vector(place * b.center_m)},
          {"half", vector(b.half_m)},
          {"rotation", quaternion(place.q * from_rotation_vector(b.rotation_deg * kRadPerDeg))}};
}

Json shape_json(const ConvexHull& hull, const Rigid& place) {
  Json points = Json::array();
  for (const Vec3& p : hull.points_m) points.push_back(vector(place * p));
  return {{"shape", "hull"}, {"points", points}};
}

// The shape, moved to `place`.
Json shape_json(const ColliderShape& shape, const Rigid& place) {
  return std::visit([&](const auto& s) { return shape_json(s, place); }, shape);
}

}  // namespace

Json colliders_json(const Character& character) {
  Json all = Json::array();
  for (const Collider& collider : character.colliders()) {
    Json solid = shape_json(collider.shape, Rigid{});
    solid["name"] = collider.name;
    solid["joint"] = character.joints()[static_cast<std::size_t>(collider.joint)].name;
    all.push_back(std::move(solid));
  }
  return all;
}

Json highlight_json(const Character& character, const Highlight& highlight) {
  Json joints = Json::array(), solids = Json::array();
  for (const int joint : highlight.joints) joints.push_back(character.joints()[static_cast<std::size_t>(joint)].name);
  for (const std::vector<int>& solid : highlight.solids) {
    Json names = Json::array();
    for (const int c : solid) names.push_back(character.colliders()[static_cast<std::size_t>(c)].name);
    solids.push_back(std::move(names));
  }
  return {{"joints", joints}, {"colliders", solids}};
}

// ---- surroundings

namespace {

GroundRegion region_of(std::span<const Rigid> path) {
  GroundRegion region{1e9, 1e9, -1e9, -1e9};
  for (const Rigid& root : path) {
    region.low_x_m = std::min(region.low_x_m, root.p_m.x), region.high_x_m = std::max(region.high_x_m, root.p_m.x);
    region.low_z_m = std::min(region.low_z_m, root.p_m.z), region.high_z_m = std::max(region.high_z_m, root.p_m.z);
  }
  region.low_x_m -= kGroundBeyond_m, region.low_z_m -= kGroundBeyond_m;
  region.high_x_m += kGroundBeyond_m, region.high_z_m += kGroundBeyond_m;
  return region;
}

// Corners that several triangles share, to a millimetre, are written once.
Json mesh_json(const std::vector<const Triangles*>& meshes) {
  std::map<std::array<std::int64_t, 3>, std::size_t> known;
  Json positions = Json::array(), indices = Json::array();
  for (const Triangles* mesh : meshes)
    for (const Vec3& p : mesh->positions_m) {
      const std::array<std::int64_t, 3> mm = {std::llround(p.x * 1e3), std::llround(p.y * 1e3),
                                              std::llround(p.z * 1e3)};
      const auto [at, is_new] = known.try_emplace(mm, known.size());
      if (is_new)
        for (const std::int64_t c : mm) positions.push_back(number(static_cast<double>(c) * 1e-3));
      indices.push_back(at->second);
    }
  return {{"positions", positions}, {"indices", indices}};
}

}  // namespace

Json ground_json(const Environment& environment, std::span<const Rigid> path) {
  bool finite = !path.empty();
  for (const Rigid& root : path) finite = finite && std::isfinite(root.p_m.x) && std::isfinite(root.p_m.z);
  if (environment.is_level() || !finite) return {{"level", number(environment.height_at(0.0, 0.0))}};
  const GroundMesh mesh = ground_mesh(environment, region_of(path));
  return mesh_json({&mesh.surface, &mesh.nosings});
}

Json obstacles_json(const Environment& environment) {
  Json all = Json::array();
  for (const ObstacleDesc& obstacle : environment.obstacles()) {
    Json solid = shape_json(obstacle.shape, environment.world_from_environment());
    solid["name"] = obstacle.name;
    all.push_back(std::move(solid));
  }
  return all;
}

// ---- events

namespace {

std::string name_of(const Intent& intent, const ActionSpan& span) {
  for (const IntendedAction& action : intent.actions)
    if (action.sequence == span.sequence && action.clip == span.clip && action.action == span.action)
      return action.name;
  return "";
}

std::span<const ChannelRun> runs_of(const Execution& execution) {
  if (!execution.foreign) return {};
  return execution.foreign->runs;
}

}  // namespace

Json spans_json(const Execution& execution) {
  Json all = Json::array();
  for (const ActionSpan& span : execution.motion.spans)
    all.push_back({{"name", execution.intent ? name_of(*execution.intent, span) : ""},
                   {"slot", execution.character->parts()[static_cast<std::size_t>(span.part)].slot},
                   {"sequence", span.sequence},
                   {"clip", span.clip},
                   {"action", span.action},
                   {"first_frame", span.first_frame},
                   {"last_frame", span.last_frame}});
  for (const ChannelRun& run : runs_of(execution))
    all.push_back({{"name", run.value.empty() ? run.channel : run.value},
                   {"slot", run.channel},
                   {"first_frame", run.first_frame},
                   {"last_frame", run.last_frame}});
  return all;
}

Json marks_json(const Execution& execution) {
  Json all = Json::array();
  const Motion& motion = execution.motion;
  for (const QueueSpan& span : motion.queue)
    if (execution.intent && span.sequence >= execution.intent->queued)
      all.push_back({{"frame", span.first_frame},
                     {"kind", "interrupt"},
                     {"text", "interrupt " + std::to_string(span.sequence - execution.intent->queued + 1)}});
  for (const ImpactMark& mark : motion.response.impacts)
    all.push_back({{"frame", mark.frame},
                   {"kind", "impact"},
                   {"text", "blow on " + execution.character->joints()[static_cast<std::size_t>(mark.joint)].name},
                   {"point", vector(mark.point_m)},
                   {"impulse", vector(mark.impulse_N_s)}});
  return all;
}

Json balance_json(const Motion& motion) {
  Json all = Json::array();
  for (const Stance& stance : motion.response.stances)
    all.push_back(stance.footing == Footing::standing
                      ? Json{{"zmp", vector(stance.zmp_m)}, {"margin", number(stance.margin_m)}}
                      : Json());
  return all;
}

Json curves_json(const std::vector<MarginCurve>& curves) {
  Json all = Json::array();
  for (const MarginCurve& curve : curves) {
    Json margins = Json::array();
    for (const double margin : curve.margins) margins.push_back(number(margin));
    all.push_back({{"check", curve.check->name},
                   {"subject", curve.subject.name},
                   {"unit", curve.subject.unit},
                   {"scale", curve.check->scale},
                   {"resolution", curve.check->resolution},
                   {"margins", std::move(margins)}});
  }
  return all;
}

}  // namespace contort::scene
