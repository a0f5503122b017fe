// SPDX-License-Identifier: BSD-3-Clause
// Symmetric matrices, as those of inertia.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>

#include "bubblesim/math.hpp"

namespace bubblesim {

using SymmetricMatrix = std::array<Vector3, 3>;  ///< its rows

inline Vector3 times(const SymmetricMatrix& rows, const Vector3& v) {
  return {rows[0].Dot(v), rows[1].Dot(v), rows[2].Dot(v)};
}

/// The matrix of a symmetric matrix in body axes, in world axes.
inline SymmetricMatrix turned(const dReal* rotation, const SymmetricMatrix& in_body) {
  const std::array<Vector3, 3> r = {Vector3(rotation[0], rotation[1], rotation[2]),
                                    Vector3(rotation[4], rotation[5], rotation[6]),
                                    Vector3(rotation[8], rotation[9], rotation[10])};
  SymmetricMatrix made;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 row = times(in_body, r[i]);
    made[i] = {row.Dot(r[0]), row.Dot(r[1]), row.Dot(r[2])};
  }
  return made;
}

/// The moments of inertia of a body about its centre of mass, kg m^2, body axes.
inline SymmetricMatrix inertia_of(dBodyID body) {
  dMass mass;
  dBodyGetMass(body, &mass);
  const dReal* rows = mass.I;  // three of four values
  return {Vector3(rows[0], rows[1], rows[2]), Vector3(rows[4], rows[5], rows[6]), Vector3(rows[8], rows[9], rows[10])};
}

/// The inverse of a symmetric matrix.
inline SymmetricMatrix inverse(const SymmetricMatrix& m) {
  const Vector3 a = m[1].Cross(m[2]);
  const Vector3 b = m[2].Cross(m[0]);
  const Vector3 c = m[0].Cross(m[1]);
  const double scale = 1 / m[0].Dot(a);
  return {a * scale, b * scale, c * scale};
}

}  // namespace bubblesim
