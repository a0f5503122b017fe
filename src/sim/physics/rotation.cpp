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
#include "physics/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/world_state.hpp"

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

/// The axes of a body in the world.
struct Axes {
  explicit Axes(dBodyID body) : r(dBodyGetRotation(body)) {}
  Vector3 to_body(const Vector3& v) const {
    return {r[0] * v.X() + r[4] * v.Y() + r[8] * v.Z(), r[1] * v.X() + r[5] * v.Y() + r[9] * v.Z(),
            r[2] * v.X() + r[6] * v.Y() + r[10] * v.Z()};
  }
  Vector3 to_world(const Vector3& v) const {
    return {r[0] * v.X() + r[1] * v.Y() + r[2] * v.Z(), r[4] * v.X() + r[5] * v.Y() + r[6] * v.Z(),
            r[8] * v.X() + r[9] * v.Y() + r[10] * v.Z()};
  }
  const dReal* r;  // three rows of four
};

/// The angle by which ODE rotates a body in a substep, rad.
double turn_of(dBodyID body, double speed, double step) {
  return dBodyGetFiniteRotationMode(body) != 0 ? speed * step : 2 * std::atan(speed * step / 2);
}

/// The change of `v` when it is rotated about `axis` by an angle in rad.
Vector3 change_by_turn(const Vector3& v, const Vector3& axis, double angle) {
  const double half = std::sin(angle / 2);
  const Vector3 across = axis.Cross(v);
  return across * std::sin(angle) + axis.Cross(across) * (2 * half * half);
}

}  // namespace

Rotation::Rotation(dBodyID body) : body_(body), inertia_(inertia_of(body)), inverse_(inverse(inertia_)) {}

bool Rotation::is_needed(dBodyID body) {
  const SymmetricMatrix inertia = inertia_of(body);
  const Vector3 diagonal(inertia[0].X(), inertia[1].Y(), inertia[2].Z());
  const Vector3 products(inertia[0].Y(), inertia[0].Z(), inertia[1].Z());
  const double size = diagonal.Max();
  return size - diagonal.Min() > kRounding * size || products.Length() > kRounding * size;
}

void Rotation::scale(double factor) {
  inertia_ = inertia_of(body_);
  inverse_ = inverse(inertia_);
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
  const Vector3 before = std::exchange(ahead_, Vector3::Zero);
  if (dBodyIsEnabled(body_) == 0) return;
  const Axes axes(body_);
  const Vector3 velocity = to_vector(dBodyGetAngularVel(body_));
  const Vector3 momentum = axes.to_world(times(inertia_, axes.to_body(velocity)));
  const bool steady = velocity.Cross(momentum).Length() * step <= kRounding * momentum.Length();
  if (steady && !carried) return;
  // The change of P - I w since the last substep, by the rotation of the inertia.
  const double speed = velocity.Length();
  const Vector3 axis = speed > 0 ? velocity / speed : Vector3::UnitX;
  Vector3 change = carried ? change_by_turn(momentum, axis, -turn_of(body_, speed, step_)) - before : Vector3::Zero;
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
  dBodyAddTorque(body_, torque.X(), torque.Y(), torque.Z());
}

Vector3 Rotation::implicit_change(const Vector3& momentum, double step) const {
  const Axes axes(body_);
  const Vector3 l = axes.to_body(momentum);
  // The columns of the matrix; Cramer's rule.
  const Vector3 x = inertia_[0] - l.Cross(Vector3::UnitX) * step;
  const Vector3 y = inertia_[1] - l.Cross(Vector3::UnitY) * step;
  const Vector3 z = inertia_[2] - l.Cross(Vector3::UnitZ) * step;
  const Vector3 yz = y.Cross(z);
  const Vector3 velocity = Vector3(l.Dot(yz), x.Dot(l.Cross(z)), x.Dot(y.Cross(l))) / x.Dot(yz);
  return axes.to_world(times(inertia_, velocity)) - momentum;
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
  Quaternion q(orientation_[0], orientation_[1], orientation_[2], orientation_[3]);
  const Vector3 turned = to_vector(dBodyGetAngularVel(body_));
  const Vector3 momentum = q.RotateVector(times(inertia_, q.RotateVectorReverse(turned)));
  const auto velocity_at = [&](const Quaternion& at) { return times(inverse_, at.RotateVectorReverse(momentum)); };
  const auto rate = [&](const Quaternion& at) {
    const Vector3 w = velocity_at(at) / 2;
    return at * Quaternion(0, w.X(), w.Y(), w.Z());
  };
  const int steps = std::clamp(static_cast<int>(turned.Length() * step / kFineTurn) + 1, 1, kMaxFineSteps);
  const double h = step / steps;
  for (int i = 0; i < steps; ++i) {
    const Quaternion k1 = rate(q);
    const Quaternion k2 = rate(q + k1 * (h / 2));
    const Quaternion k3 = rate(q + k2 * (h / 2));
    const Quaternion k4 = rate(q + k3 * h);
    q = q + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6);
    q.Normalize();
  }
  const Vector3 velocity = q.RotateVector(velocity_at(q));
  const dQuaternion rotation = {q.W(), q.X(), q.Y(), q.Z()};
  dBodySetQuaternion(body_, rotation);
  dBodySetAngularVel(body_, velocity.X(), velocity.Y(), velocity.Z());
}

void begin_rotations(World::State& state, double step) {
  for (PlacedModel* model : state.moving) {
    for (Rotation& rotation : model->rotations) rotation.begin(step);
  }
}

void end_rotations(World::State& state, double step) {
  for (PlacedModel* model : state.moving) {
    for (Rotation& rotation : model->rotations) rotation.end(step);
  }
}

}  // namespace bubblesim
