// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/nearest_inertia.hpp"

#include <Eigen/Eigenvalues>

namespace bubblesim {

std::optional<Inertia> nearest_positive_definite(const Inertia& inertia) {
  constexpr double kLeast = 1e-3;  // of the greatest moment
  const Vector3& d = inertia.diagonal;
  const Vector3& p = inertia.products;
  Eigen::Matrix3d matrix;
  matrix << d.X(), p.X(), p.Y(), p.X(), d.Y(), p.Z(), p.Y(), p.Z(), d.Z();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  const double greatest = solver.eigenvalues().maxCoeff();
  if (!(greatest > 0)) return std::nullopt;
  const Eigen::Vector3d moments = solver.eigenvalues().cwiseMax(kLeast * greatest);
  const Eigen::Matrix3d nearest = solver.eigenvectors() * moments.asDiagonal() * solver.eigenvectors().transpose();
  return Inertia{{nearest(0, 0), nearest(1, 1), nearest(2, 2)}, {nearest(0, 1), nearest(0, 2), nearest(1, 2)}};
}

}  // namespace bubblesim
