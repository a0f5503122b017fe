// SPDX-License-Identifier: BSD-3-Clause
// Two integrators, see docs/adr/0025-rotation-joints-and-stops.md.
//
// A free body: ODE's step yields the angular momentum L, and the orientation follows from it by
//   q' = q (0, w) / 2,  w = I^-1 R(q)^T L   (body axes, L constant during the substep; Runge-Kutta of fourth order).
//
// A body with joints or contacts: ODE solves I(q0) w1 = I(q0) w0 + h (torques), with the inertia at the start of the
// substep. The torque added here replaces it by the inertia in the middle of the substep and carries the angular
// momentum P from substep to substep, so that P changes by the other torques only:
//   I(q1/2) w1 = P + h (torques).
// As a rotation about w leaves w unchanged, I w at an orientation that is rotated about w is the rotated I w.
#include "physics/parts/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

/// Relative change of the angular momentum in a substep below which a rotation is one about a principal axis.
constexpr double kRounding = 1e-13;
/// rad in a substep, of a body with joints or contacts. Above, its inertia in the middle of the substep is too
/// uncertain; then the torque is implicit, which damps the rotation and is stable at any speed: (I - h [L]x) w1 = L,
/// after C. Lacoursiere, "Stabilizing gyroscopic forces in rigid multibody simulations", 2006.
constexpr double kMaxTurn = 1.5;
/// rad, of one step of the Runge-Kutta method.
constexpr double kFineTurn = 0.05;
constexpr int kMaxFineSteps = 1000;

/// The angle by which ODE rotates a body in a substep, rad.
double turn_of(dBodyID body, double speed, double step) {
  return dBodyGetFiniteRotationMode(body) != 0 ? speed * step : 2 * std::atan(speed * step / 2);
}

/// The change of `v` when it is rotated about `axis` by an angle in rad.
Vector3 change_by_turn(const Vector3& v, const Vector3& axis, double angle) {
  const double half = std::sin(angle / 2);
  const Vector3 across = axis.cross(v);
  return across * std::sin(angle) + axis.cross(across) * (2 * half * half);
}

}  // namespace

Rotation::Rotation(dBodyID body) : body_(body), inertia_(inertia_of(body)), inverse_(inertia_.inverse()) {}

bool Rotation::is_needed(dBodyID body) {
  const Matrix3 inertia = inertia_of(body);
  const Vector3 diagonal = inertia.diagonal();
  const Vector3 products(inertia(0, 1), inertia(0, 2), inertia(1, 2));
  const double size = diagonal.maxCoeff();
  return size - diagonal.minCoeff() > kRounding * size || products.norm() > kRounding * size;
}

void Rotation::scale(double factor) {
  inertia_ = inertia_of(body_);
  inverse_ = inertia_.inverse();
  ahead_ *= factor;
}

void Rotation::transfer(StateArchive& archive) {
  archive(free_, constrained_, ahead_, step_);
  archive.bytes(orientation_, sizeof orientation_);
  archive.bytes(velocity_, sizeof velocity_);
}

bool Rotation::was_moved() const {
  return !std::equal(velocity_, velocity_ + 3, dBodyGetAngularVel(body_)) ||
         !std::equal(orientation_, orientation_ + 4, dBodyGetQuaternion(body_));
}

void Rotation::begin(double step) {
  const bool carried = constrained_ && !was_moved();
  free_ = constrained_ = false;
  const Vector3 before = std::exchange(ahead_, {});
  if (dBodyIsEnabled(body_) == 0) return;
  const Matrix3 axes = to_matrix(dBodyGetRotation(body_));
  const Vector3 velocity = to_vector(dBodyGetAngularVel(body_));
  const Vector3 momentum = axes * (inertia_ * (axes.transpose() * velocity));
  const bool steady = velocity.cross(momentum).norm() * step <= kRounding * momentum.norm();
  if (steady && !carried) return;
  // The change of P - I w since the last substep, by the rotation of the inertia.
  const double speed = velocity.norm();
  const Vector3 axis = speed > 0 ? Vector3(velocity / speed) : Vector3::UnitX();
  Vector3 change;
  if (carried) change = change_by_turn(momentum, axis, -turn_of(body_, speed, step_)) - before;
  if (dBodyGetNumJoints(body_) == 0) {
    free_ = true;
    std::copy_n(dBodyGetQuaternion(body_), 4, orientation_);
  } else if (speed * step > kMaxTurn) {
    change += implicit_change(momentum, step);
  } else {
    constrained_ = true;
    ahead_ = -change_by_turn(momentum, axis, turn_of(body_, speed, step) / 2);
    change += ahead_;
  }
  const Vector3 torque = change / step;
  dBodyAddTorque(body_, torque.x(), torque.y(), torque.z());
}

Vector3 Rotation::implicit_change(const Vector3& momentum, double step) const {
  const Matrix3 axes = to_matrix(dBodyGetRotation(body_));
  const Vector3 l = axes.transpose() * momentum;
  Matrix3 matrix = inertia_;
  for (int i = 0; i < 3; ++i) matrix.col(i) -= l.cross(Vector3::Unit(i)) * step;
  return axes * (inertia_ * (matrix.inverse() * l)) - momentum;
}

void Rotation::end(double step) {
  if (free_ && dBodyIsEnabled(body_) != 0) turn_freely(step);
  if (!constrained_) return;
  std::copy_n(dBodyGetQuaternion(body_), 4, orientation_);
  std::copy_n(dBodyGetAngularVel(body_), 3, velocity_);
  step_ = step;
}

void Rotation::turn_freely(double step) {
  // ODE has rotated the body by its new velocity; its momentum is that at the orientation before.
  Quaternion q = to_quaternion(orientation_);
  const Vector3 turned = to_vector(dBodyGetAngularVel(body_));
  const Vector3 momentum = q * (inertia_ * (q.conjugate() * turned));
  const auto velocity_at = [&](const Quaternion& at) -> Vector3 { return inverse_ * (at.conjugate() * momentum); };
  const auto rate = [&](const Eigen::Vector4d& at) -> Eigen::Vector4d {
    const Quaternion turn(at[3], at[0], at[1], at[2]);  // not quite of unit length within a step
    const Vector3 w = velocity_at(turn.normalized()) / 2;
    return (turn * Quaternion(0, w.x(), w.y(), w.z())).coeffs();
  };
  const int steps = std::clamp(static_cast<int>(turned.norm() * step / kFineTurn) + 1, 1, kMaxFineSteps);
  const double h = step / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector4d at = q.coeffs();
    const Eigen::Vector4d k1 = rate(at);
    const Eigen::Vector4d k2 = rate(at + k1 * (h / 2));
    const Eigen::Vector4d k3 = rate(at + k2 * (h / 2));
    const Eigen::Vector4d k4 = rate(at + k3 * h);
    q.coeffs() += (k1 + k2 * 2 + k3 * 2 + k4) * (h / 6);
    q.normalize();
  }
  const Vector3 velocity = q * velocity_at(q);
  dBodySetQuaternion(body_, to_ode(q).data());
  dBodySetAngularVel(body_, velocity.x(), velocity.y(), velocity.z());
}

}  // namespace bubblesim
