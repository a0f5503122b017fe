// SPDX-License-Identifier: BSD-3-Clause
// Contacts of bodies without joints, by sequential impulses that start from those of the last substep: see
// docs/adr/0024.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "bubblesim/math.hpp"
#include "physics/contacts/contact_memory.hpp"
#include "physics/contacts/contact_rows.hpp"
#include "physics/contacts/found_contacts.hpp"

namespace bubblesim {

struct Link;

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
  int a = 0;
  int b = 0;          // the static world is body 0
  double height = 0;  // m, along gravity
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
};

/// Resistance to rolling about the tangents and to spinning about the normal.
struct SolvedSpin {
  std::array<SolvedRow, 2> roll;
  SolvedRow spin;
  Coupling coupling;    // of the two axes of rolling
  double rolling = 0;   // m
  double spinning = 0;  // m
};

/// Solves islands one by one; its vectors are working memory.
class ContactSolver {
 public:
  /// Starts an island.
  void clear();
  /// The number of a link's body; adds it as it will move in the substep without contacts. 0 is the static world.
  int number_of(const Link& link, const Vector3& gravity, double step);
  /// Adds a point between two bodies, or a body and the static world (0). Starts from what is
  /// expected of it.
  void add_point(int a, int b, const FoundContact& found, std::size_t index, const ExpectedContact& start,
                 double height, double step);
  /// Finds the impulses, and applies them as forces in the coming substep. Sets FoundContact::force.
  void solve(std::vector<FoundContact>& points, double step);

 private:
  void add_body(const Link& link, const Vector3& gravity, double step);
  /// Solves each point once; returns the largest change of a velocity in m/s.
  double sweep();
  /// The square of the change of the impulses by the last sweep.
  double squared_step() const;
  /// Continues in the direction of the sweeps before (nonsmooth nonlinear conjugate gradients: Silcowitz, Niebe and
  /// Erleben, The Visual Computer 26, 2010).
  void accelerate(double part);
  double solve_point(SolvedPoint& point);
  /// Adds the resistances to rolling and spinning of a point.
  void add_spin(SolvedPoint& point, const dSurfaceParameters& surface, const Vector3& expected);
  double solve_spin(const SolvedPoint& point, SolvedSpin& spin);
  void apply(const SolvedPoint& point, SolvedRow& row, double impulse);
  double speed(const SolvedPoint& point, const SolvedRow& row) const;
  SolvedRow make_row(int a, int b, const Vector3& direction, const Vector3& lever_a, const Vector3& lever_b) const;
  SolvedRow make_turning_row(int a, int b, const Vector3& axis) const;
  void finish_row(int a, int b, SolvedRow& row) const;

  std::vector<int> numbers_;  // of bodies, by Link::number; 0: not in the island
  std::vector<SolvedBody> bodies_;
  std::vector<SolvedPoint> points_;
  std::vector<SolvedSpin> spins_;
};

}  // namespace bubblesim
