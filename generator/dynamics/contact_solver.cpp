#include "generator/dynamics/contact_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr int kSweepsOfContacts = 40;
constexpr double kAtRest_m_s = 1e-5;  // a sweep that changes no row's speed by more than this is the last one

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
  link_ = -1;
  if (!is_stiff) return;
  root_factors_.assign(at(kRootDofs * kRootDofs), 0.0);
  for (std::size_t i = 0; i < kRootDofs; ++i)
    for (std::size_t j = 0; j <= i; ++j) root_factors_[i * kRootDofs + j] = equation.mass[i * size_ + j];
  factorise_symmetric(root_factors_, kRootDofs);
}

// The row's jacobian and answer have been appended.
void ContactSolver::add_row(const Row& row) {
  rows_.push_back(row);
  rows_.back().softness = dot(jacobian(rows_.size() - 1), answer(rows_.size() - 1));
}

void ContactSolver::solve_answer(std::span<double> right) const {
  if (is_stiff_)
    solve_factorised(root_factors_, kRootDofs, right.first(kRootDofs));
  else
    contort::solve(equation_->body(), equation_->factors, right);
}

// A link's six: unit moments, then unit forces, about the root's origin. Points of one link share them.
void ContactSolver::find_link(int link) {
  if (link == link_) return;
  link_ = link;
  link_rows_.assign(size_, Six{});
  const Multibody& body = equation_->body();
  const Link& last = body.links()[at(link)];
  link_first_dof_ = kRootDofs;
  link_end_dof_ = std::max(at(last.dof + last.dof_count), at(kRootDofs));
  for (int k = last.dof + last.dof_count - 1; k >= 0; k = body.parent_dof()[at(k)]) {
    if (is_stiff_ && k >= kRootDofs) continue;
    if (k >= kRootDofs) link_first_dof_ = at(k);
    const SpatialMotion& freedom = equation_->dynamics.freedoms[at(k)];
    link_rows_[at(k)] = {freedom.angular.x, freedom.angular.y, freedom.angular.z,
                         freedom.linear.x,  freedom.linear.y,  freedom.linear.z};
  }
  link_answers_ = link_rows_;
  if (!is_stiff_) return solve_six(equation_->body(), equation_->factors, link_answers_);
  std::array<double, kRootDofs> column;
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t k = 0; k < kRootDofs; ++k) column[k] = link_answers_[k][c];
    solve_answer(column);
    for (std::size_t k = 0; k < kRootDofs; ++k) link_answers_[k][c] = column[k];
  }
}

namespace {

double sum_of(const Six& shares, const Six& entries) {
  double sum = 0.0;
  for (std::size_t c = 0; c < shares.size(); ++c) sum += shares[c] * entries[c];
  return sum;
}

}  // namespace

void ContactSolver::add_touch(const TouchedPoint& touch) {
  find_link(touch.link);
  Vec3 axes[3] = {touch.normal};
  across(touch.normal, axes[1], axes[2]);
  const int normal = static_cast<int>(rows_.size());
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 moment = glm::cross(touch.from_root_m, axes[axis]);
    const Six wrench{moment.x, moment.y, moment.z, axes[axis].x, axes[axis].y, axes[axis].z};
    for (const Six& entries : link_rows_) jacobians_.push_back(sum_of(wrench, entries));
    for (const Six& entries : link_answers_) answers_.push_back(sum_of(wrench, entries));
    add_row({.least_speed = axis == 0 ? touch.least_m_s : 0.0,
             .preload = touch.preload_N_s,
             .normal = axis == 0 ? -1 : normal,
             .is_sole = touch.is_sole,
             .first_dof = link_first_dof_,
             .end_dof = link_end_dof_});
  }
}

void ContactSolver::add_pair(const BodyContact& pair, double least_m_s) {
  if (is_stiff_) return;  // nothing parts two bodies of a stiff figure
  jacobians_.resize(jacobians_.size() + size_, 0.0);
  const std::span<double> row = std::span(jacobians_).last(size_);
  std::size_t first = size_, end = kRootDofs;
  for_openings(equation_->body(), equation_->dynamics, pair, [&](std::size_t dof, double opens) {
    row[dof] = opens;
    first = std::min(first, dof), end = std::max(end, dof + 1);
  });
  answers_.insert(answers_.end(), jacobians_.end() - static_cast<std::ptrdiff_t>(size_), jacobians_.end());
  solve_answer(std::span(answers_).last(size_));
  add_row({.least_speed = least_m_s, .is_own = true, .first_dof = std::min(first, end), .end_dof = end});
}

void ContactSolver::add_stop(int dof, double sense, double least_speed) {
  add_stop_row({.least_speed = least_speed, .stop_dof = dof, .stop_sense = Vec3(sense, 0.0, 0.0)});
}

void ContactSolver::add_ball_stop(int dof, const Vec3& sense, double least_speed) {
  add_stop_row({.least_speed = least_speed, .stop_dof = dof, .stop_dofs = 3, .stop_sense = sense});
}

void ContactSolver::add_stop_row(const Row& row) {
  jacobians_.resize(jacobians_.size() + size_, 0.0);
  for (int i = 0; i < row.stop_dofs; ++i) std::span(jacobians_).last(size_)[at(row.stop_dof + i)] = row.stop_sense[i];
  answers_.insert(answers_.end(), jacobians_.end() - static_cast<std::ptrdiff_t>(size_), jacobians_.end());
  solve_answer(std::span(answers_).last(size_));
  add_row(row);
}

double ContactSolver::stopped_speed(const Row& row, std::span<const double> velocity) const {
  double speed = row.stop_sense[0] * velocity[at(row.stop_dof)];
  for (int i = 1; i < row.stop_dofs; ++i) speed += row.stop_sense[i] * velocity[at(row.stop_dof + i)];
  return speed;
}

// Only freedoms between the row's link and the root move its point.
double ContactSolver::speed_of(std::size_t k, std::span<const double> velocity) {
  const std::span<const double> row = jacobian(k);
  double speed = 0.0;
  for (std::size_t i = 0; i < kRootDofs; ++i) speed += row[i] * velocity[i];
  if (is_stiff_) return speed;
  for (std::size_t i = rows_[k].first_dof; i < rows_[k].end_dof; ++i) speed += row[i] * velocity[i];
  return speed;
}

// Answers by how much the row's own speed changes.
double ContactSolver::push(std::size_t k, std::span<double> velocity) {
  Row& row = rows_[k];
  if (!(row.softness > 0.0)) return 0.0;
  const double pressed = row.normal >= 0 ? rows_[at(row.normal)].impulse + row.preload : 0.0;
  if (row.normal >= 0 && pressed == 0.0 && row.impulse == 0.0) return 0.0;  // nothing to rub with
  const double speed = row.stop_dof >= 0 ? stopped_speed(row, velocity) : speed_of(k, velocity);
  const double next = row.impulse + (row.least_speed - speed) / row.softness;
  double impulse = std::max(-row.preload, next);
  if (row.normal >= 0) {
    const double most = kFriction * pressed;
    impulse = std::clamp(next, -most, most);
  }
  const double change = impulse - row.impulse;
  if (change == 0.0) return 0.0;
  add_scaled(change, answer(k), velocity);
  row.impulse = impulse;
  return std::fabs(change) * row.softness;
}

void ContactSolver::solve(std::span<double> velocity) {
  for (int sweep = 0; sweep < kSweepsOfContacts; ++sweep) {
    double most_m_s = 0.0;
    for (std::size_t k = 0; k < rows_.size(); ++k) most_m_s = std::max(most_m_s, push(k, velocity));
    if (most_m_s < kAtRest_m_s) return;
  }
}

bool ContactSolver::pushes(bool soles) const {
  return std::ranges::any_of(rows_, [&](const Row& row) {
    return row.stop_dof < 0 && row.normal < 0 && !row.is_own && row.is_sole == soles && row.impulse > 0.0;
  });
}

}  // namespace contort
