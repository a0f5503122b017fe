// SPDX-License-Identifier: BSD-3-Clause
#include "surface_pair.hpp"

#include <algorithm>
#include <limits>

#include "contact_defaults.hpp"

namespace bubblesim {
namespace {

constexpr double kSoftest = 1e-3;  // N/m
/// A stiffer contact gives less under a robot's weight than the layer in which rigid ones rest.
constexpr double kStiff = 1e6;  // N/m

using Optional = std::optional<double>;

/// The lower of two values of which any may be missing.
Optional lower(const Optional& a, const Optional& b) { return a && b ? std::min(*a, *b) : (a ? a : b); }
Optional higher(const Optional& a, const Optional& b) { return a && b ? std::max(*a, *b) : (a ? a : b); }

/// Two springs one behind the other, two dampers side by side: what both do in a step, in ODE's terms. Tells whether
/// the contact is one of rigid bodies after all.
bool soften(const Surface& a, const Surface& b, double step, dSurfaceParameters& made) {
  const auto compliance = [](const Surface& surface) { return 1 / std::max(surface.kp.value_or(kRigid), kSoftest); };
  const double kp = 1 / (compliance(a) + compliance(b));
  if (kp < kStiff) {
    const double kd = a.kd.value_or(0) + b.kd.value_or(0);
    made.mode |= dContactSoftERP | dContactSoftCFM;
    made.soft_erp = step * kp / (step * kp + kd);
    made.soft_cfm = 1 / (step * kp + kd);
    return false;
  }
  if (a.kp || b.kp) return true;
  if (const Optional erp = lower(a.soft_erp, b.soft_erp)) {
    made.mode |= dContactSoftERP;
    made.soft_erp = *erp;
  }
  if (const Optional cfm = higher(a.soft_cfm, b.soft_cfm)) {
    made.mode |= dContactSoftCFM;
    made.soft_cfm = std::max(*cfm, kConstraintSoftness);
  }
  return true;
}

}  // namespace

SurfacePair combine(const Surface& a, const Surface& b, double step) {
  SurfacePair pair;
  dSurfaceParameters& made = pair.ode;
  // Approximation 1 makes mu a coefficient; without it ODE takes mu as a force and wheels drift outwards.
  made.mode = dContactApprox1;
  made.mu = std::min(a.mu, b.mu);
  made.mu2 = std::min(a.mu2.value_or(a.mu), b.mu2.value_or(b.mu));
  if (made.mu2 != made.mu) made.mode |= dContactMu2;
  const bool a_directed = a.fdir1 != Vector3::Zero;
  const bool b_directed = b.fdir1 != Vector3::Zero;
  if (a_directed || b_directed) pair.directed = a_directed && (!b_directed || a.mu <= b.mu) ? &a : &b;

  made.slip1 = a.slip1 + b.slip1;
  made.slip2 = a.slip2 + b.slip2;
  if (made.slip1 > 0) made.mode |= dContactSlip1;
  if (made.slip2 > 0) made.mode |= dContactSlip2;

  made.rhoN = std::max(a.torsion, b.torsion);
  if (made.rhoN > 0) made.mode |= dContactRolling | dContactAxisDep;

  made.bounce = std::min(a.restitution, b.restitution);
  made.bounce_vel = std::min(a.bounce_threshold, b.bounce_threshold);
  if (made.bounce > 0) made.mode |= dContactBounce;

  made.soft_erp = kErrorReduction;
  const bool rigid = soften(a, b, step, made);
  pair.sink = std::max(lower(a.min_depth, b.min_depth).value_or(kSurfaceLayer), kSurfaceLayer);
  // What is soft pushes as its spring does; a limit would let heavy things sink in.
  const double speed = higher(a.max_vel, b.max_vel).value_or(kMaxCorrectingVelocity);
  pair.max_depth = rigid && made.soft_erp > 0 ? speed * step / made.soft_erp : std::numeric_limits<double>::infinity();
  return pair;
}

}  // namespace bubblesim
