// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/contact_cone.hpp"

#include <algorithm>
#include <cmath>

#include "physics/ode/ode_math.hpp"
#include "physics/parts/collider.hpp"

namespace bubblesim {
namespace {

// A slide can turn: the second direction keeps this part of the limit at least, and the first as much as makes friction
// 0.9975 to 1.0025 times that of Coulomb's cone.
constexpr double kAcross = 0.1;
constexpr double kAlong = 1 - kAcross * kAcross / 4;
constexpr double kNotable = 0.1;  // of the limit; less friction has no direction
constexpr double kSlides = 1e-3;  // m/s
// Rolling can turn: each direction keeps this part of the limit at least.
constexpr double kRollsAcross = 0.02;
constexpr double kRolls = 1e-3;  // rad/s

Vector3 velocity_at(const Collider& shape, const dReal* position) {
  dBodyID body = shape.link->body.get();
  if (body == nullptr) return {};
  dVector3 velocity;
  dBodyGetPointVel(body, position[0], position[1], position[2], velocity);
  return to_vector(velocity);
}

/// Sets the first friction direction along a tangent of the contact plane.
void direct_along(const Vector3& tangent, dContact& contact) {
  const Vector3 unit = tangent / tangent.norm();
  contact.surface.mode |= dContactFDir1;
  for (unsigned i = 0; i < 3; ++i) contact.fdir1[i] = unit[i];
}

/// The first friction direction of ODE's contact joint.
Vector3 first_direction(const dContact& contact) {
  if ((contact.surface.mode & dContactFDir1) != 0) return to_vector(contact.fdir1);
  dVector3 first;
  dVector3 second;
  dPlaneSpace(contact.geom.normal, first, second);  // as ODE
  return to_vector(first);
}

Vector3 tangential(const Vector3& vector, const dContact& contact) {
  const Vector3 normal = to_vector(contact.geom.normal);
  return vector - normal * vector.dot(normal);
}

/// Whether the friction is the same in all directions, so that its directions may be chosen.
bool is_isotropic(const dContact& contact) {
  const dSurfaceParameters& surface = contact.surface;
  return surface.mu2 == surface.mu && (surface.mode & (dContactFDir1 | dContactSlip1 | dContactSlip2)) == 0;
}

Vector3 slip_at(const FoundPair& pair, const dContact& contact) {
  const dReal* position = contact.geom.pos;
  return tangential(velocity_at(*pair.first, position) - velocity_at(*pair.second, position), contact);
}

void direct_along_slip(const FoundPair& pair, dContact& contact) {
  const Vector3 slip = slip_at(pair, contact);
  if (slip.norm() > kSlides) direct_along(slip, contact);
}

Vector3 spin_of(const Collider& shape) {
  dBodyID body = shape.link->body.get();
  return body == nullptr ? Vector3() : to_vector(dBodyGetAngularVel(body));
}

/// Divides the resistance to rolling between its two axes, which are the friction directions, so that it opposes
/// rolling in any direction; at rest, so that the torque that acts remains within the limit.
void limit_rolling(const FoundPair& pair, const ExpectedContact& expected, dContact& contact) {
  dSurfaceParameters& surface = contact.surface;
  if (surface.rho == 0) return;
  Vector3 along = tangential(spin_of(*pair.first) - spin_of(*pair.second), contact);
  double least = kRollsAcross;
  if (along.norm() < kRolls) {
    along = tangential(expected.torque, contact);
    const double limit = surface.rho * expected.limit;
    const double share = limit > 0 ? std::min(along.norm() / limit, 1.0) : 0;
    least = std::max(std::sqrt(1 - share * share), kRollsAcross);
  }
  const double length = along.norm();
  const double first = length > 0 ? std::min(std::abs(along.dot(first_direction(contact))) / length, 1.0) : 1;
  surface.rho2 = surface.rho * std::max(std::sqrt(1 - first * first), least);
  surface.rho *= std::max(first, least);
}

void limit_point(const FoundPair& pair, const ExpectedContact& expected, bool iterative, FoundContact& point) {
  dContact& contact = point.contact;
  dSurfaceParameters& surface = contact.surface;
  const double limit = surface.mu * expected.limit;
  double first = 1;  // parts of the limit
  double second = 1;
  const bool isotropic = is_isotropic(contact);
  if (isotropic && limit > 0 && std::isfinite(limit)) {
    const Vector3 friction = tangential(expected.friction, contact);
    const double share = friction.norm() / limit;
    if (share > kNotable) {
      direct_along(friction, contact);
      first = kAlong;
      second = std::sqrt(std::max(1 - share * share, kAcross * kAcross));
    } else {
      direct_along_slip(pair, contact);
    }
  }
  surface.mu2 = isotropic || (surface.mode & dContactMu2) == 0 ? surface.mu * second : surface.mu2;
  surface.mu *= first;
  surface.mode |= dContactMu2;
  limit_rolling(pair, expected, contact);
  if (iterative) return;
  point.limit.normal = expected.limit;
  surface.mode &= ~dContactApprox1;
  surface.mu *= expected.limit;
  surface.mu2 *= expected.limit;
  surface.rho *= expected.limit;
  surface.rho2 *= expected.limit;
  surface.rhoN *= expected.limit;
}

}  // namespace

void limit_friction(const FoundPair& pair, const RememberedPair* remembered, const ContactMemory& memory, double step,
                    bool iterative, FoundContact* points) {
  for (int i = 0; i < pair.count; ++i) {
    const dSurfaceParameters& surface = points[i].contact.surface;
    points[i].limit = {surface.mode, surface.mu, surface.mu2, surface.rho, surface.rhoN};
  }
  if (remembered == nullptr || !is_settled(*remembered)) {
    for (int i = 0; i < pair.count; ++i) {
      if (is_isotropic(points[i].contact)) direct_along_slip(pair, points[i].contact);
      limit_rolling(pair, {}, points[i].contact);
    }
    return;
  }
  const ExpectedContacts expected = expect(memory, *remembered, pair, points, step);
  for (int i = 0; i < pair.count; ++i) limit_point(pair, expected[static_cast<std::size_t>(i)], iterative, points[i]);
}

void limit_friction(const FoundPair& pair, double normal, FoundContact& point) {
  dSurfaceParameters& surface = point.contact.surface;
  const FrictionLimit& given = point.limit;
  surface.mode = given.mode;
  surface.mu = given.mu;
  surface.mu2 = given.mu2;
  surface.rho = surface.rho2 = given.rolling;
  surface.rhoN = given.torsion;
  limit_point(pair, {normal, tangential(point.force, point.contact), point.torque, normal}, false, point);
}

double needed_normal(const FoundContact& point) {
  const dContact& contact = point.contact;
  const FrictionLimit& surface = point.limit;
  const Vector3 friction = tangential(to_vector(point.feedback.f1), contact);
  if (surface.mu2 == surface.mu) return surface.mu > 0 ? friction.norm() / surface.mu : 0;
  const double first = friction.dot(first_direction(contact));
  const double second = std::sqrt(std::max(friction.squaredNorm() - first * first, 0.0));
  const auto needed = [](double force, double mu) { return mu > 0 ? std::abs(force) / mu : 0; };
  return std::max(needed(first, surface.mu), needed(second, surface.mu2));
}

bool slides(const FoundPair& pair, const FoundContact& point) { return slip_at(pair, point.contact).norm() > kSlides; }

}  // namespace bubblesim
