// A character as MuJoCo sees it: the independent oracle for dynamics. Tests and bench only.
#pragma once

#ifdef CONTORT_HAS_MUJOCO

#include <mujoco/mujoco.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tests/dynamics/states.h"

namespace contort::fixtures {

// Decides whether MuJoCo's bodies have colliding shapes: those of the colliders, in the judged pairs of bodies.
enum class Shapes { none, colliders };

class MujocoModel {
 public:
  explicit MujocoModel(const Character& character, Shapes shapes = Shapes::none);
  ~MujocoModel();
  MujocoModel(const MujocoModel&) = delete;
  MujocoModel& operator=(const MujocoModel&) = delete;

  mjModel* model() { return model_; }
  mjData* data() { return data_; }

  // Pose, velocities and accelerations in MuJoCo's order.
  void set(const Multibody& body, const DynamicsState& state);
  // A posture in its order.
  std::vector<double> coords_of(const Multibody& body, const Rigid& root, std::span<const double> row) const;

  // A vector over its freedoms, in our order.
  std::vector<double> ours(const Multibody& body, const mjtNum* theirs) const;
  // Its dense mass matrix in our order.
  std::vector<double> mass_matrix(const Multibody& body);
  int dof_of(int link) const { return dofs_[static_cast<std::size_t>(link)]; }

 private:
  mjModel* model_ = nullptr;
  mjData* data_ = nullptr;
  std::vector<int> coords_;  // by link
  std::vector<int> dofs_;
};

// The model as MJCF text.
std::string mjcf_of(const Character& character, Shapes shapes = Shapes::none);

}  // namespace contort::fixtures

#endif
