// SPDX-License-Identifier: BSD-3-Clause
// Volumes of hulls that grow, compared with theory and with qhull.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "meshes/convex_hull.hpp"
#include "meshes/growing_hull.hpp"

namespace bubblesim::test::test_growing_hull {
namespace {

TEST(GrowingHull, OfACubeWithPointsOnItsFacesIsTheCube) {
  GrowingHull hull(std::sqrt(3));
  constexpr int kSteps = 10;
  for (int x = 0; x <= kSteps; ++x) {
    for (int y = 0; y <= kSteps; ++y) {
      for (int z = 0; z <= kSteps; ++z) hull.add(Vector3(x, y, z) / kSteps);
    }
    EXPECT_NEAR(hull.volume(), 1.0 * x / kSteps, 2e-4) << x;
  }
}

TEST(GrowingHull, OfPointsInAPlaneHasNoVolume) {
  GrowingHull hull(2);
  for (int i = 0; i < 50; ++i) hull.add({std::cos(i), std::sin(i), 0.5});
  EXPECT_NEAR(hull.volume(), 0, 1e-3);
}

TEST(GrowingHull, HasTheVolumeThatQhullFinds) {
  std::mt19937 random(11);
  std::normal_distribution<float> value;
  for (int round = 0; round < 20; ++round) {
    TriangleMesh cloud;
    GrowingHull hull(6);
    const bool on_ball = round % 2 == 0;
    for (int i = 0; i < 10 + 40 * round; ++i) {
      Vector3 point(value(random), value(random), value(random));
      if (on_ball) point.normalize();
      cloud.vertices.push_back(
          {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())});
      hull.add(point);
    }
    const Hull expected = convex_hull(cloud);
    const double volume = enclosed_volume(expected.triangles, [&](std::uint32_t i) { return expected.corners[i]; });
    EXPECT_NEAR(hull.volume(), volume, 1e-3 * volume) << cloud.vertices.size() << " points";
  }
}

}  // namespace
}  // namespace bubblesim::test::test_growing_hull
