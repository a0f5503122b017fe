// SPDX-License-Identifier: BSD-3-Clause
// The contacts of one substep, by pairs of shapes.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim {

struct Collider;

/// From which normal force a contact of ODE's exact solver has its friction limit.
struct FrictionLimit {
  static constexpr double kNone = -1;

  int mode = 0;  ///< of the contact's surface, and its coefficients; ODE's contact has limits in N
  double mu = 0;
  double mu2 = 0;
  double rolling = 0;     ///< m
  double torsion = 0;     ///< m
  double normal = kNone;  ///< N; kNone: that of ODE's solution without friction
  double relied = kNone;  ///< N, on which the friction of the last solution relies, see FrictionIteration
};

/// A contact point. Its normal points into the first shape of its pair.
struct FoundContact {
  FoundContact(const dSurfaceParameters& surface, const dContactGeom& place, bool has_own_correction_)
      : has_own_correction(has_own_correction_) {
    contact.surface = surface;
    contact.geom = place;
    std::fill_n(contact.fdir1, 4, 0);
  }

  dContact contact;
  bool has_own_correction = false;  ///< see SurfacePair
  dJointFeedback feedback{};        ///< of ODE's contact joint, which keeps a pointer to it
  Vector3 force;                    ///< N, on the first shape, in world axes; known after the substep
  Vector3 torque;                   ///< N m, likewise, about the point: where there is resistance to rolling
  FrictionLimit limit;              ///< of a contact of ODE's exact solver
};

/// Two shapes that touch. The number of the first is the lower; it has a body.
struct FoundPair {
  const Collider* first = nullptr;
  const Collider* second = nullptr;
  std::size_t begin = 0;  ///< of its points
  int count = 0;
};

struct FoundContacts {
  std::vector<FoundPair> pairs;  ///< in the order of the numbers of their shapes
  std::vector<FoundContact> points;

  void clear() {
    pairs.clear();
    points.clear();
  }
};

}  // namespace bubblesim
