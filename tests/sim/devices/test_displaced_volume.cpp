// SPDX-License-Identifier: BSD-3-Clause
// The volumes of shapes below a plane, compared with formulas and with sums over a fine grid.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"
#include "devices/displaced_volume.hpp"
#include "meshes/made_meshes.hpp"

namespace bubblesim::test::test_displaced_volume {
namespace {

const std::vector<Vector3>& directions() {
  static const std::vector<Vector3> all = {Vector3::UnitX(),
                                           -Vector3::UnitX(),
                                           Vector3::UnitY(),
                                           Vector3::UnitZ(),
                                           -Vector3::UnitZ(),
                                           Vector3(1, 2, 3).normalized(),
                                           Vector3(-0.3, 0.1, -1).normalized(),
                                           Vector3(1e-7, 0, 1).normalized(),
                                           Vector3(1, 0, 1e-7).normalized()};
  return all;
}

bool contains(const Box& box, const Vector3& p) {
  return std::abs(p.x()) <= box.size.x() / 2 && std::abs(p.y()) <= box.size.y() / 2 &&
         std::abs(p.z()) <= box.size.z() / 2;
}
bool contains(const Cylinder& c, const Vector3& p) {
  return std::hypot(p.x(), p.y()) <= c.radius && std::abs(p.z()) <= c.length / 2;
}
bool contains(const Capsule& c, const Vector3& p) {
  return std::hypot(p.x(), p.y(), std::max(std::abs(p.z()) - c.length / 2, 0.0)) <= c.radius;
}
bool contains(const Sphere& s, const Vector3& p) { return p.norm() <= s.radius; }
bool contains(const Ellipsoid& e, const Vector3& p) { return p.cwiseQuotient(e.radii).norm() <= 1; }

/// A sum over cubes of 2 cm, within a cube of 1.2 m.
template <class Shape>
Displaced summed(const Shape& shape, const Vector3& up, double height) {
  constexpr int kCount = 60;
  constexpr double kSide = 1.2 / kCount;
  Displaced sum;
  for (int i = 0; i < kCount * kCount * kCount; ++i) {
    const Vector3 p = (Vector3(i % kCount, i / kCount % kCount, i / kCount / kCount) + Vector3::Ones() * 0.5) * kSide -
                      Vector3::Ones() * 0.6;
    if (!contains(shape, p) || up.dot(p) > height) continue;
    sum.volume += kSide * kSide * kSide;
    sum.moment += p * (kSide * kSide * kSide);
  }
  return sum;
}

template <class Shape>
void expect_like_sum(const Shape& shape) {
  for (const Vector3& up : directions()) {
    for (const double height : {-0.3, -0.1, 0.0, 0.2}) {
      const Displaced found = displaced_below(shape, up, height);
      const Displaced wanted = summed(shape, up, height);
      EXPECT_NEAR(found.volume, wanted.volume, 0.012) << up << " " << height;
      EXPECT_LT((found.moment - wanted.moment).norm(), 0.005) << up << " " << height;
    }
  }
}

TEST(DisplacedVolume, IsThatOfAFineGrid) {
  expect_like_sum(Box{{0.92, 0.68, 0.52}});  // its sides are between the cubes
  expect_like_sum(Sphere{0.5});
  expect_like_sum(Ellipsoid{{0.5, 0.35, 0.25}});
  expect_like_sum(Cylinder{0.3, 0.9});
  expect_like_sum(Capsule{0.25, 0.5});
}

template <class Shape>
void expect_whole(const Shape& shape, double volume) {
  for (const Vector3& up : directions()) {
    EXPECT_NEAR(displaced_below(shape, up, 2).volume, volume, 1e-9 * volume) << up;
    EXPECT_LT(displaced_below(shape, up, 2).moment.norm(), 1e-9) << up;
    EXPECT_NEAR(displaced_below(shape, up, -2).volume, 0, 1e-12) << up;
    EXPECT_NEAR(displaced_below(shape, up, 0).volume, volume / 2, 1e-6 * volume) << up;
    // The two sides of a plane together are the shape.
    const double below = displaced_below(shape, up, 0.11).volume;
    EXPECT_NEAR(below + displaced_below(shape, -up, -0.11).volume, volume, 1e-6 * volume) << up;
  }
}

TEST(DisplacedVolume, OfTheWholeShapeIsItsVolume) {
  expect_whole(Box{{0.9, 0.7, 0.5}}, 0.315);
  expect_whole(Sphere{0.5}, 4.0 / 3 * M_PI * 0.125);
  expect_whole(Ellipsoid{{0.5, 0.35, 0.25}}, 4.0 / 3 * M_PI * 0.5 * 0.35 * 0.25);
  expect_whole(Cylinder{0.3, 0.9}, M_PI * 0.09 * 0.9);
  expect_whole(Capsule{0.25, 0.5}, M_PI * 0.0625 * 0.5 + 4.0 / 3 * M_PI * 0.25 * 0.0625);
}

TEST(DisplacedVolume, OfALyingCylinderIsItsSegment) {
  const double r = 0.3;
  for (const double height : {-0.25, -0.1, 0.0, 0.2}) {
    const double segment = r * r * std::acos(-height / r) + height * std::sqrt(r * r - height * height);
    EXPECT_NEAR(displaced_below(Cylinder{r, 0.9}, Vector3::UnitX(), height).volume, segment * 0.9, 1e-9);
  }
}

TEST(DisplacedVolume, OfAStandingCapsuleIsExact) {
  // Height 0.35 above the middle: the lower half ball, the barrel and a slice of the upper half ball.
  const double r = 0.25;
  const double slice = M_PI * (r * r * 0.1 - 0.001 / 3);
  EXPECT_NEAR(displaced_below(Capsule{r, 0.5}, Vector3::UnitZ(), 0.35).volume,
              2.0 / 3 * M_PI * r * r * r + M_PI * r * r * 0.5 + slice, 1e-9);
}

TEST(DisplacedVolume, OfAMeshIsThatOfItsPolyhedron) {
  const std::shared_ptr<const TriangleMesh> square =
      extrude({{{{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}}, 0.5}});  // from z = 0 to 0.5
  for (const Vector3& up : directions()) {
    const Displaced mesh = displaced_below(Mesh{square}, up, 0.2);
    const Vector3 offset(0, 0, 0.25);
    const Displaced box = displaced_below(Box{Vector3::Ones() * 0.5}, up, 0.2 - up.dot(offset));
    EXPECT_NEAR(mesh.volume, box.volume, 1e-8) << up;
    EXPECT_LT((mesh.moment - box.moment - offset * box.volume).norm(), 1e-8) << up;
  }
}

}  // namespace
}  // namespace bubblesim::test::test_displaced_volume
