#include "generator/dynamics/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr int kSweepsOfContacts = 40;

// Two unit vectors at right angles to a unit one and to each other.
void across(const Vec3& normal, Vec3& first, Vec3& second) {
  const Vec3 other = std::fabs(normal.x) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  first = glm::normalize(glm::cross(normal, other));
  second = glm::cross(normal, first);
}

}  // namespace

void ContactSolver::begin(const EquationOfMotion& equation, bool is_stiff) {
  equation_ = &equation;
  is_stiff_ = is_stiff;
  size_ = equation.size();
  rows_.clear(), jacobians_.clear(), answers_.clear();
  if (!is_stiff) return;
  root_factors_.assign(at(kRootDofs * kRootDofs), 0.0);
  for (std::size_t i = 0; i < kRootDofs; ++i)
    for (std::size_t j = 0; j <= i; ++j) root_factors_[i * kRootDofs + j] = equation.mass[i * size_ + j];
  factorise_symmetric(root_factors_, kRootDofs);
}

// The row's jacobian has been appended.
void ContactSolver::add_row(const Row& row) {
  rows_.push_back(row);
  const std::size_t k = rows_.size() - 1;
  answers_.insert(answers_.end(), jacobians_.end() - static_cast<std::ptrdiff_t>(size_), jacobians_.end());
  if (is_stiff_)
    solve_factorised(root_factors_, kRootDofs, answer(k).first(kRootDofs));
  else
    contort::solve(equation_->body(), equation_->factors, answer(k));
  rows_.back().softness = dot(jacobian(k), answer(k));
}

void ContactSolver::add_touch(const TouchedPoint& touch) {
  const Multibody& body = equation_->body();
  Vec3 axes[3] = {touch.normal};
  across(touch.normal, axes[1], axes[2]);
  const int normal = static_cast<int>(rows_.size());
  for (int axis = 0; axis < 3; ++axis) {
    jacobians_.resize(jacobians_.size() + size_, 0.0);
    const std::span<double> row = std::span(jacobians_).last(size_);
    const Link& last = body.links()[at(touch.link)];
    for (int k = last.dof + last.dof_count - 1; k >= 0; k = body.parent_dof()[at(k)]) {
      if (is_stiff_ && k >= kRootDofs) continue;
      const SpatialMotion& freedom = equation_->dynamics.freedoms[at(k)];
      row[at(k)] = glm::dot(axes[axis], freedom.linear + glm::cross(freedom.angular, touch.from_root_m));
    }
    add_row({0.0, axis == 0 ? touch.least_m_s : 0.0, touch.preload_N_s, 0.0, axis == 0 ? -1 : normal, false,
             touch.is_sole});
  }
}

void ContactSolver::add_stop(int dof, double sense, double least_speed) {
  jacobians_.resize(jacobians_.size() + size_, 0.0);
  std::span(jacobians_).last(size_)[at(dof)] = sense;
  add_row({0.0, least_speed, 0.0, 0.0, -1, true, false});
}

void ContactSolver::push(std::size_t k, std::span<double> velocity) {
  Row& row = rows_[k];
  if (!(row.softness > 0.0)) return;
  const double next = row.impulse + (row.least_speed - dot(jacobian(k), velocity)) / row.softness;
  double impulse = std::max(-row.preload, next);
  if (row.normal >= 0) {
    const double most = kFriction * (rows_[at(row.normal)].impulse + row.preload);
    impulse = std::clamp(next, -most, most);
  }
  add_scaled(impulse - row.impulse, answer(k), velocity);
  row.impulse = impulse;
}

void ContactSolver::solve(std::span<double> velocity) {
  for (int sweep = 0; sweep < kSweepsOfContacts; ++sweep)
    for (std::size_t k = 0; k < rows_.size(); ++k) push(k, velocity);
}

bool ContactSolver::pushes(bool soles) const {
  return std::ranges::any_of(rows_, [&](const Row& row) {
    return !row.is_stop && row.normal < 0 && row.is_sole == soles && row.impulse > 0.0;
  });
}

}  // namespace contort
