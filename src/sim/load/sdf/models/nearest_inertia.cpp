// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/nearest_inertia.hpp"

#include <Eigen/Eigenvalues>

namespace bubblesim {

std::optional<Inertia> nearest_positive_definite(const Inertia& inertia) {
  constexpr double kLeast = 1e-3;  // of the greatest moment
  const Vector3& d = inertia.diagonal;
  const Vector3& p = inertia.products;
  Matrix3 matrix;
  matrix << d.x(), p.x(), p.y(), p.x(), d.y(), p.z(), p.y(), p.z(), d.z();
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(matrix);
  const double greatest = solver.eigenvalues().maxCoeff();
  if (!(greatest > 0)) return std::nullopt;
  const Vector3 moments = solver.eigenvalues().cwiseMax(kLeast * greatest);
  const Matrix3 nearest = solver.eigenvectors() * moments.asDiagonal() * solver.eigenvectors().transpose();
  return Inertia{nearest.diagonal(), {nearest(0, 1), nearest(0, 2), nearest(1, 2)}};
}

}  // namespace bubblesim
