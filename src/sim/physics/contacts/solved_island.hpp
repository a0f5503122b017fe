// SPDX-License-Identifier: BSD-3-Clause
// Bodies without joints that touch each other, and their contacts, while they are solved.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/contacts/contact_rows.hpp"

namespace bubblesim {

/// A body during the solution.
struct SolvedBody {
  dBodyID body = nullptr;
  int link = 0;                               // Link::number
  double inverse_mass = 0;                    // 1/kg
  Matrix3 inverse_inertia = Matrix3::Zero();  // 1/(kg m^2), in world axes
  Vector3 velocity;                           // m/s, of the centre of mass, at the end of the substep
  Vector3 spin;                               // rad/s, likewise
};

struct SolvedPoint {
  SolvedRow normal;
  std::array<SolvedRow, 2> tangent;
  Coupling coupling;  // of the tangents
  double target = 0;  // m/s
  double mu = 0;
  double mu2 = 0;
  bool isotropic = true;
  int spinning = -1;  // of its resistances to rotation; -1: none
  std::size_t found = 0;
  std::array<double, 3> before{};  // N s, impulses of the normal and the tangents before a sweep
  std::array<double, 3> search{};  // direction of the conjugate gradients

  std::array<SolvedRow*, 3> rows() { return {&normal, &tangent[0], &tangent[1]}; }
  std::array<const SolvedRow*, 3> rows() const { return {&normal, &tangent[0], &tangent[1]}; }
};

/// Resistance to rolling about the tangents and to spinning about the normal.
struct SolvedSpin {
  std::array<SolvedRow, 2> roll;
  SolvedRow spin;
  Coupling coupling;    // of the two axes of rolling
  double rolling = 0;   // m
  double spinning = 0;  // m
};

/// Two bodies, or a body and the static world, that touch in points. The points are solved one after the other by the
/// motion of the bodies relative to each other; the bodies themselves get the impulses of all points at once.
struct SolvedPair {
  int a = 0;
  int b = 0;                  // the static world is body 0
  Vector3 lever_a;            // m, from the centre of mass of a to the origin, where velocities and moments are taken
  Vector3 lever_b;            // m, likewise
  double height = 0;          // m, of the origin along gravity
  double extent = 0;          // m, the greatest distance of a point from the origin
  std::size_t begin = 0;      // of its points
  std::size_t end = 0;        // after them
  Matrix3 effect[2][2] = {};  // of an impulse and a moment on a velocity and a spin
};

/// The motion of a pair while its points are solved.
struct PairMotion {
  SpatialVector motion = SpatialVector::Zero();  // of the first body relative to the second, m/s and rad/s
  SpatialVector given = SpatialVector::Zero();  // what the first body has to get, and the second to lose, N s and N m s

  double speed(const SolvedRow& row) const { return row.along.dot(motion); }
  void apply(SolvedRow& row, double impulse) {
    row.impulse += impulse;
    motion += row.effect * impulse;
    given += row.along * impulse;
  }
};

struct SolvedIsland {
  std::vector<SolvedBody> bodies;  // the first is the static world
  std::vector<SolvedPair> pairs;
  std::vector<SolvedPoint> points;
  std::vector<SolvedSpin> spins;

  SpatialVector motion_of(const SolvedPair& pair) const {
    const SolvedBody& a = bodies[static_cast<std::size_t>(pair.a)];
    const SolvedBody& b = bodies[static_cast<std::size_t>(pair.b)];
    SpatialVector motion;
    motion << a.velocity + a.spin.cross(pair.lever_a) - b.velocity - b.spin.cross(pair.lever_b), a.spin - b.spin;
    return motion;
  }
};

}  // namespace bubblesim
