// MuJoCo's own humanoid: compares all distances between its bodies at rest with MuJoCo's; there must be no
// self-collision. Skipped without libmujoco or the model (shared/assets beside the repository).
#include <gtest/gtest.h>

#ifdef CONTORT_HAS_MUJOCO
#include <mujoco/mujoco.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "model/geometry/distance.h"

namespace contort {
namespace {

const std::string kHumanoid = std::string(CONTORT_SOURCE_DIR) + "/../shared/assets/robots/mjcf/mujoco/humanoid.xml";
constexpr double kMargin_m = 10.0;  // large enough that MuJoCo measures every pair

using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using Data = std::unique_ptr<mjData, decltype(&mj_deleteData)>;
using GeomPair = std::pair<int, int>;

Model load_humanoid() {
  char error[1000] = "";
  Model model(mj_loadXML(kHumanoid.c_str(), nullptr, error, sizeof error), &mj_deleteModel);
  EXPECT_NE(model, nullptr) << error;
  if (model == nullptr) return model;
  std::fill_n(model->geom_margin, model->ngeom, kMargin_m);
  std::fill_n(model->geom_gap, model->ngeom, kMargin_m);  // contacts without forces
  model->nconmax = 2000, model->njmax = 8000;
  return model;
}

// The least distance of each pair of geoms that MuJoCo measures, without the floor.
std::map<GeomPair, double> distances_of(const mjModel& model, const mjData& data) {
  std::map<GeomPair, double> out;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    if (model.geom_bodyid[contact.geom1] == 0 || model.geom_bodyid[contact.geom2] == 0) continue;
    const GeomPair pair = std::minmax(contact.geom1, contact.geom2);
    const auto known = out.emplace(pair, contact.dist).first;
    known->second = std::min(known->second, contact.dist);
  }
  return out;
}

Solid solid_of_geom(const mjModel& model, const mjData& data, int geom) {
  const mjtNum* p = data.geom_xpos + 3 * geom;
  const mjtNum* m = data.geom_xmat + 9 * geom;  // row by row
  const mjtNum* size = model.geom_size + 3 * geom;
  const Vec3 center(p[0], p[1], p[2]);
  if (model.geom_type[geom] == mjGEOM_SPHERE) return solid_of(Sphere{center, size[0]});
  EXPECT_EQ(model.geom_type[geom], mjGEOM_CAPSULE);
  const Vec3 half = size[1] * Vec3(m[2], m[5], m[8]);
  return solid_of(Capsule{center - half, center + half, size[0]});
}

// Returns true for pairs that MuJoCo judges: not in one body, not in neighbours, and not excluded. Bodies without a
// joint count as the body that carries them.
bool may_touch(const mjModel& model, int a, int b) {
  const int body_a = model.geom_bodyid[a], body_b = model.geom_bodyid[b];
  const int whole_a = model.body_weldid[body_a], whole_b = model.body_weldid[body_b];
  const auto carrier = [&](int whole) { return model.body_weldid[model.body_parentid[whole]]; };
  if (whole_a == 0 || whole_b == 0 || whole_a == whole_b) return false;
  if (carrier(whole_a) == whole_b || carrier(whole_b) == whole_a) return false;
  const int low = std::min(body_a, body_b) + 1, high = std::max(body_a, body_b) + 1;  // 2.2 counts them from 1
  return std::find(model.exclude_signature, model.exclude_signature + model.nexclude, (low << 16) + high) ==
         model.exclude_signature + model.nexclude;
}

TEST(MujocoHumanoid, DoesNotTouchItselfAtRestAndIsMeasuredAsMujocoDoes) {
  if (!std::filesystem::exists(kHumanoid)) GTEST_SKIP() << kHumanoid << " is not there";
  const Model model = load_humanoid();
  ASSERT_NE(model, nullptr);
  const Data data(mj_makeData(model.get()), &mj_deleteData);
  mj_kinematics(model.get(), data.get());
  mj_comPos(model.get(), data.get());
  mj_collision(model.get(), data.get());
  const std::map<GeomPair, double> theirs = distances_of(*model, *data);
  std::size_t pairs = 0;
  for (int a = 0; a < model->ngeom; ++a)
    for (int b = a + 1; b < model->ngeom; ++b) {
      if (!may_touch(*model, a, b)) continue;
      ++pairs;
      const double ours = signed_distance(solid_of_geom(*model, *data, a), solid_of_geom(*model, *data, b), 1e9);
      const auto found = theirs.find({a, b});
      ASSERT_NE(found, theirs.end()) << a << " and " << b;
      EXPECT_NEAR(ours, found->second, 1e-9) << a << " and " << b;
      EXPECT_GT(ours, 0.0) << a << " and " << b;
    }
  EXPECT_EQ(pairs, theirs.size());
  EXPECT_GT(pairs, 100U);
}

}  // namespace
}  // namespace contort

#endif  // CONTORT_HAS_MUJOCO
