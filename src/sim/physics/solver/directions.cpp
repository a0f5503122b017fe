// SPDX-License-Identifier: BSD-3-Clause
#include "physics/solver/directions.hpp"

#include "scene/simd.hpp"

namespace bubblesim {
namespace {

BUBBLESIM_INLINE void add_products(const double* const* components, const double* factors, int count,
                                   double* __restrict__ to) {
  const double* const a = components[0];
  const double* const b = components[1];
  const double* const c = components[2];
  const double* const d = components[3];
  const double* const e = components[4];
  const double* const f = components[5];
  for (int i = 0; i < count; ++i) {
    to[i] += (a[i] * factors[0] + b[i] * factors[1] + c[i] * factors[2]) +
             (d[i] * factors[3] + e[i] * factors[4] + f[i] * factors[5]);
  }
}

BUBBLESIM_SIMD void add_many_products(const double* const* components, const double* factors, int count,
                                      double* __restrict__ to) {
  add_products(components, factors, count, to);
}

}  // namespace

void Directions::add() {
  for (std::vector<double>& component : components_) component.push_back(0);
}

void Directions::set(int dof, const SpatialLanes& direction) {
  const auto at = static_cast<std::size_t>(dof);
  for (std::size_t i = 0; i < 3; ++i) {
    components_[i][at] = direction.angular[i];
    components_[i + 3][at] = direction.linear[i];
  }
}

void Directions::project(const Vector3& moment, const Vector3& force, int first, int count, double* to) const {
  const double* from[6];
  for (std::size_t i = 0; i < 6; ++i) from[i] = components_[i].data() + first;
  const double factors[6] = {moment.x(), moment.y(), moment.z(), force.x(), force.y(), force.z()};
  if (count < 4) return add_products(from, factors, count, to);  // wheels: a call would take longer
  add_many_products(from, factors, count, to);
}

}  // namespace bubblesim
