// SPDX-License-Identifier: BSD-3-Clause
// A substep moves a body along the tangent of its path, and its joint opens by h^2 w^2 r / 2. The correction in the
// next substep makes the velocity that of the chord; a small one lags behind the motion and takes its energy. Above 1
// it extrapolates. Only while bodies swing: at rest it would keep rounding errors alive, and ODE's exact solver finds
// no solution more often.
#include "physics/motion/joint_correction.hpp"

#include <cmath>

#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

constexpr double kAtRest = 1;
constexpr double kInMotion = 1.4;       // measured: docs/adr/0025
constexpr double kLeastOpening = 1e-6;  // m, in a substep
constexpr double kLeastLever = 1e-4;    // m

bool swings(const PlacedModel& model, double step) {
  for (const Lever& lever : model.levers) {
    const dReal* w = dBodyGetAngularVel(lever.body);
    if ((w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) * step * step * lever.length / 2 > kLeastOpening) return true;
  }
  return false;
}

}  // namespace

void note_lever(PlacedModel& model, dBodyID body, const Vector3& anchor) {
  if (body == nullptr) return;
  const double length = (anchor - to_vector(dBodyGetPosition(body))).norm();
  if (length > kLeastLever) model.levers.push_back({body, length});
}

void correct_joints(const MovingModels& moving, dWorldID world, double step) {
  double part = kAtRest;
  for (const PlacedModel* model : moving.awake) {
    if (!swings(*model, step)) continue;
    part = kInMotion;
    break;
  }
  dWorldSetERP(world, part);
}

}  // namespace bubblesim
