// SPDX-License-Identifier: BSD-3-Clause
// Convex parts of concave meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bubblesim/scene.hpp"
#include "meshes/convex_parts.hpp"
#include "meshes/made_meshes.hpp"

namespace bubblesim::test::test_convex_parts {
namespace {

double volume(const Hull& hull) {
  return enclosed_volume(hull.triangles, [&](std::uint32_t i) { return hull.corners[i]; });
}

double sum_of_volumes(const ConvexParts& parts) {
  double sum = 0;
  for (const Hull& hull : parts.hulls) sum += volume(hull);
  return sum;
}

TEST(ConvexParts, OfAnLAreItsTwoLegs) {
  const Outline outline = {{0, 0}, {0.2, 0}, {0.2, 0.07}, {0.07, 0.07}, {0.07, 0.2}, {0, 0.2}};
  const ConvexParts parts = convex_parts(*extrude({{outline, 0.1}}));
  ASSERT_EQ(parts.hulls.size(), 2U);
  EXPECT_NEAR(sum_of_volumes(parts), (0.2 * 0.07 + 0.13 * 0.07) * 0.1, 1e-8);
  for (const Hull& hull : parts.hulls) EXPECT_EQ(hull.corners.size(), 8U);
  EXPECT_NEAR(parts.excess, 0, 1e-5);
}

TEST(ConvexParts, OfAnArchAndOfACrossAreBoxes) {
  const Outline arch = {{-0.4, 0}, {-0.3, 0}, {-0.3, 0.4}, {0.3, 0.4}, {0.3, 0}, {0.4, 0}, {0.4, 0.5}, {-0.4, 0.5}};
  const Outline cross = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                         {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  for (const Outline& outline : {arch, cross}) {
    const ConvexParts parts = convex_parts(*extrude({{outline, 0.4}}));
    EXPECT_EQ(parts.hulls.size(), 3U);
    EXPECT_NEAR(parts.excess, 0, 1e-5);
  }
}

TEST(ConvexParts, OfARingFitWithinAFewPercent) {
  // A square ring is four boxes; a round one needs many parts.
  const Outline outer = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const Outline inner = {{-0.6, -0.6}, {0.6, -0.6}, {0.6, 0.6}, {-0.6, 0.6}};
  const ConvexParts square = convex_parts(*extrude({{outer, 0.4}, {inner, 0.4}}));
  EXPECT_EQ(square.hulls.size(), 4U);
  EXPECT_NEAR(sum_of_volumes(square), (4 - 1.44) * 0.4, 1e-5);

  Outline round_outer;
  Outline round_inner;
  for (int i = 0; i < 32; ++i) {
    round_outer.emplace_back(std::cos(M_PI * i / 16), std::sin(M_PI * i / 16));
    round_inner.emplace_back(0.7 * std::cos(M_PI * i / 16), 0.7 * std::sin(M_PI * i / 16));
  }
  const ConvexParts round = convex_parts(*extrude({{round_outer, 0.4}, {round_inner, 0.4}}));
  EXPECT_LE(round.hulls.size(), 16U);
  EXPECT_LT(round.excess, 0.05);
  EXPECT_GT(round.excess, 0);
}

TEST(ConvexParts, OfAGearAreAsManyAsFit) {
  Outline teeth;
  Outline bore;
  constexpr int kTeeth = 20;
  for (int i = 0; i < 4 * kTeeth; ++i) {
    const double angle = 2 * M_PI * i / (4 * kTeeth);
    const double radius = i % 4 < 2 ? 1 : 0.7;
    teeth.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    bore.emplace_back(0.3 * std::cos(angle), 0.3 * std::sin(angle));
  }
  const std::shared_ptr<const TriangleMesh> gear = extrude({{teeth, 0.4}, {bore, 0.4}});
  PartLimits limits;
  limits.most = limits.usual;
  EXPECT_GT(convex_parts(*gear, limits).excess, limits.excess);
  const ConvexParts parts = convex_parts(*gear);
  EXPECT_GT(parts.hulls.size(), limits.usual);
  EXPECT_LE(parts.hulls.size(), PartLimits().most);
  EXPECT_LE(parts.excess, limits.excess);
}

TEST(ConvexParts, OfAnOpenSurfaceHaveNoVolume) {
  TriangleMesh open = *extrude({{{{0, 0}, {1, 0}, {1, 1}, {0.5, 0.2}}, 1}});
  open.triangles.resize(open.triangles.size() - 3);
  EXPECT_TRUE(std::isinf(convex_parts(open).excess));
}

}  // namespace
}  // namespace bubblesim::test::test_convex_parts
