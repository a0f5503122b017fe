// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/surface_pair.hpp"

#include <algorithm>
#include <limits>

#include "physics/ode/constraint_defaults.hpp"

namespace bubblesim {
namespace {

constexpr double kMostFriction = 1e9;  // some files have an infinite coefficient
constexpr double kSoftest = 1e-3;      // N/m
/// Above this stiffness, the deflection under a robot's weight is smaller than the overlap of rigid contacts.
constexpr double kStiff = 1e6;  // N/m

using Optional = std::optional<double>;

/// The lower of two values; a missing value is ignored. Without both: `otherwise`.
double lower(const Optional& a, const Optional& b, double otherwise) {
  return a && b ? std::min(*a, *b) : a ? *a : b ? *b : otherwise;
}
double higher(const Optional& a, const Optional& b, double otherwise) {
  return a && b ? std::max(*a, *b) : a ? *a : b ? *b : otherwise;
}

/// Softness of a contact, in ODE's terms.
struct Softness {
  int mode = dContactSoftERP;  // the world's is that of the joints
  double erp = kErrorReduction;
  double cfm = 0;
  bool rigid = true;
  bool has_own_correction = false;
  double least = 0;  // of the softness of a rigid contact
};

/// Springs in series, dampers in parallel: their combined effect in a step.
Softness soften(const Surface& a, const Surface& b, double step) {
  Softness made;
  if (a.kp || b.kp) {
    const auto compliance = [](const Surface& surface) { return 1 / std::max(surface.kp.value_or(kRigid), kSoftest); };
    const double kp = 1 / (compliance(a) + compliance(b));
    const double kd = a.kd.value_or(0) + b.kd.value_or(0);
    if (kp >= kStiff) {
      made.least = 1 / (step * kp + kd);
      return made;
    }
    return {dContactSoftERP | dContactSoftCFM, step * kp / (step * kp + kd), 1 / (step * kp + kd), false, true, 0};
  }
  made.has_own_correction = a.soft_erp || b.soft_erp;
  made.erp = lower(a.soft_erp, b.soft_erp, made.erp);
  if (a.soft_cfm || b.soft_cfm) {
    made.mode |= dContactSoftCFM;
    made.cfm = std::max(higher(a.soft_cfm, b.soft_cfm, 0), kConstraintSoftness);
  }
  return made;
}

}  // namespace

SurfacePair combine(const Surface& a, const Surface& b, double step) {
  SurfacePair pair;
  dSurfaceParameters& made = pair.ode;
  // Approximation 1 makes mu a coefficient; without it mu is a force in ODE and wheels drift outwards.
  made.mode = dContactApprox1;
  made.mu = bounded_friction(std::min(a.mu, b.mu));
  made.mu2 = bounded_friction(std::min(a.mu2.value_or(a.mu), b.mu2.value_or(b.mu)));
  if (made.mu2 != made.mu) made.mode |= dContactMu2;

  // Like Gazebo since 7.9: "combines surface slip parameters with a sum" (its Migration.md, ODEPhysics::Collide).
  made.slip1 = a.slip1 + b.slip1;
  made.slip2 = a.slip2 + b.slip2;
  if (made.slip1 > 0) made.mode |= dContactSlip1;
  if (made.slip2 > 0) made.mode |= dContactSlip2;
  // With equal limits a direction would only make a square of Coulomb's cone. Wheels often have one, and turn with it.
  const bool is_isotropic = made.mu2 == made.mu && made.slip1 == made.slip2;
  const bool a_directed = !is_isotropic && a.fdir1 != Vector3::Zero();
  const bool b_directed = !is_isotropic && b.fdir1 != Vector3::Zero();
  if (a_directed || b_directed) pair.directed = a_directed && (!b_directed || a.mu <= b.mu) ? &a : &b;

  made.rhoN = std::max(a.torsion, b.torsion);
  made.rho = made.rho2 = std::max(a.rolling, b.rolling);
  pair.torsion_by_depth = std::max(a.torsion_by_depth, b.torsion_by_depth);
  // ODE's dContactAxisDep is dContactMu2; mu2 is always set.
  if (made.rhoN > 0 || made.rho > 0 || pair.torsion_by_depth > 0) made.mode |= dContactRolling | dContactAxisDep;

  made.bounce = std::min(a.restitution, b.restitution);
  made.bounce_vel = std::min(a.bounce_threshold, b.bounce_threshold);
  if (made.bounce > 0) made.mode |= dContactBounce;

  const Softness softness = soften(a, b, step);
  made.mode |= softness.mode;
  made.soft_erp = softness.erp;
  made.soft_cfm = softness.cfm;
  pair.has_own_correction = softness.has_own_correction;
  pair.least_softness = softness.least;
  pair.sink = std::max(lower(a.min_depth, b.min_depth, kSurfaceLayer), kSurfaceLayer);
  // Sink to the full depth at once: otherwise each wheel rests at a different depth, and a robot leans.
  if (softness.rigid && pair.sink > kSurfaceLayer && made.bounce == 0) pair.sink_speed = kMaxCorrectingVelocity;
  // A soft contact pushes with its spring force; with a limit, heavy bodies would sink in.
  const double speed = higher(a.max_vel, b.max_vel, kMaxCorrectingVelocity);
  const bool limited = softness.rigid && softness.erp > 0;
  pair.max_depth = limited ? speed * step / softness.erp : std::numeric_limits<double>::infinity();
  return pair;
}

double bounded_friction(double coefficient) { return std::min(coefficient, kMostFriction); }

void share_load(double inverse_mass, double step, SurfacePair& pair) {
  // A contact that yields bounces less.
  if ((pair.ode.mode & (dContactSoftCFM | dContactBounce)) != 0) return;
  pair.ode.mode |= dContactSoftCFM;
  pair.ode.soft_cfm = std::max({kLoadSharing * step * inverse_mass, kConstraintSoftness, pair.least_softness});
}

}  // namespace bubblesim
