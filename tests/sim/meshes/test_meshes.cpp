// SPDX-License-Identifier: BSD-3-Clause
// Meshes from outlines and images, and convex hulls.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "meshes.hpp"
#include "meshes/convex_hull.hpp"
#include "meshes/made_meshes.hpp"
#include "near.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_meshes {
namespace {

using Point2 = Eigen::Vector2d;

Vector3 size(const TriangleMesh& mesh) { return mesh.high - mesh.low; }

TEST(Surface, LosesTrianglesWithoutAnArea) {
  TriangleMesh mesh = box_triangles({1, 1, 1});
  mesh.triangles.push_back({0, 0, 1});
  EXPECT_EQ(finish_mesh(mesh)->triangles.size(), 12U);
}

TEST(Surface, WithArraysThatDoNotFitIsTurnedDown) {
  const TriangleMesh whole = box_triangles({1, 1, 1});
  const auto problem = [&](const auto& change) {
    TriangleMesh mesh = whole;
    change(mesh);
    return mesh_problem([&] { finish_mesh(mesh); });
  };
  const std::string vertices = "for some of its vertices";
  const std::string material = "a material that does not exist";
  EXPECT_NE(problem([](TriangleMesh& mesh) { mesh.normals.resize(1); }).find(vertices), std::string::npos);
  EXPECT_NE(problem([](TriangleMesh& mesh) { mesh.texture_coordinates.resize(1); }).find(vertices), std::string::npos);
  EXPECT_NE(problem([](TriangleMesh& mesh) { mesh.materials.resize(1); }).find(material), std::string::npos);
  EXPECT_NE(problem([](TriangleMesh& mesh) {
              mesh.materials.resize(1);
              mesh.material_of.assign(mesh.triangles.size(), 1);
            }).find(material),
            std::string::npos);
}

TEST(Surface, HasFinitePlacesOnItsTexture) {
  TriangleMesh mesh = box_triangles({1, 1, 1});
  mesh.texture_coordinates.assign(mesh.vertices.size(), {NAN, 0.5F});
  EXPECT_EQ(finish_mesh(mesh)->texture_coordinates.front(), (std::array<float, 2>{0, 0.5F}));
}

TEST(Surface, WithNumbersThatAreNoneIsTurnedDown) {
  TriangleMesh mesh = box_triangles({1, 1, 1});
  mesh.vertices[3][1] = NAN;
  EXPECT_NE(mesh_problem([&] { finish_mesh(mesh); }).find("not finite"), std::string::npos);
  mesh = box_triangles({1, 1, 1});
  mesh.triangles[3][1] = 8;
  EXPECT_NE(mesh_problem([&] { finish_mesh(mesh); }).find("does not exist"), std::string::npos);
  mesh.triangles.clear();
  EXPECT_NE(mesh_problem([&] { finish_mesh(mesh); }).find("no triangle"), std::string::npos);
}

class Extrusion : public ::testing::TestWithParam<bool> {};

TEST_P(Extrusion, OfAConcaveOutlineEnclosesItsAreaTimesItsHeight) {
  // An L: three unit squares.
  std::vector<Point2> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  if (GetParam()) std::reverse(outline.begin(), outline.end());
  const auto mesh = extrude({{outline, 0.5}});
  EXPECT_NEAR(volume(*mesh), 1.5, 1e-6);
  expect_near(size(*mesh), {2, 2, 0.5}, kMeshRounding);
}

INSTANTIATE_TEST_SUITE_P(EitherWayRound, Extrusion, ::testing::Bool());

TEST(Extrusions, TakeAClosedOutlineAndCornersInOneLine) {
  EXPECT_NEAR(volume(*extrude({{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, 1}})), 4, 1e-6);
}

TEST(Extrusions, StateWhatIsWrongWithAnOutline) {
  EXPECT_EQ(mesh_problem([] { extrude({{{{0, 0}, {1, 0}}, 1}}); }), "has fewer than three corners");
  EXPECT_EQ(mesh_problem([] { extrude({{{{0, 0}, {1, 0}, {2, 0}}, 1}}); }), "has no area");
  EXPECT_EQ(mesh_problem([] { extrude({{{{0, 0}, {1, 0}, {1, 1}}, 0}}); }), "must have a height above 0");
  EXPECT_EQ(mesh_problem([] { extrude({{{{0, 0}, {2, 2}, {2, 0}, {0, 3}}, 1}}); }), "crosses itself");
}

TEST(Extrusions, HaveHolesWhereOutlinesLieInOthers) {
  const auto square = [](double half, double x = 0) {
    return std::vector<Point2>{{x - half, -half}, {x + half, -half}, {x + half, half}, {x - half, half}};
  };
  // A frame with a pillar in it, two windows in a wall, and two squares that cross.
  EXPECT_NEAR(volume(*extrude({{square(3), 1}, {square(2), 1}, {square(1), 1}})), 36 - 16 + 4, 1e-5);
  EXPECT_NEAR(volume(*extrude({{square(1, -2), 1}, {square(4), 0.5}, {square(1, 2), 1}})), (64 - 4 - 4) * 0.5, 1e-5);
  EXPECT_NEAR(volume(*extrude({{square(1), 1}, {square(1, 1.5), 1}})), 8, 1e-5);
}

TEST(Walls, StandOnTheDarkPixelsOfAPicture) {
  // Three pixels in an L, of 3 x 2; the image's upper edge is at +y.
  const Heights picture{3, 2, {0, 1, 1, 0, 0.5F, 1}};
  const auto mesh = raise_walls(picture, 0.1, 200, 2);
  EXPECT_NEAR(volume(*mesh), 3 * 0.1 * 0.1 * 2, 1e-6);
  expect_near(mesh->low, {-0.15, -0.1, 0}, kMeshRounding);
  expect_near(mesh->high, {0.05, 0.1, 2}, kMeshRounding);
  EXPECT_EQ(mesh_problem([&] { raise_walls(picture, 0.1, 0, 1); }), "has no pixel darker than the <threshold>");
}

TEST(Ground, HasItsUpperEdgeAtPlusYAndItsBrightestPixelAtItsHeight) {
  const Heights heights{3, 2, {0.5F, 0, 0, 0, 0, 0}};
  const auto mesh = raise_ground(heights, {4, 2, 3}, {10, 0, 1});
  expect_near(mesh->low, {8, -1, 1}, kMeshRounding);
  expect_near(mesh->high, {12, 1, 4}, kMeshRounding);
  const auto top = std::find_if(mesh->vertices.begin(), mesh->vertices.end(),
                                [](const TriangleMesh::Point& point) { return point[2] > 3.9F; });
  ASSERT_NE(top, mesh->vertices.end());
  EXPECT_FLOAT_EQ((*top)[0], 8);
  EXPECT_FLOAT_EQ((*top)[1], 1);
}

TEST(Ground, OfALargePictureIsThinnedOutToItsEdges) {
  Heights heights{2000, 3, std::vector<float>(6000, 0.0F)};
  heights.values.back() = 1;
  const auto mesh = raise_ground(heights, {1, 1, 1});
  EXPECT_EQ(mesh->triangles.size(), 2U * 512 * 2);
  EXPECT_EQ(mesh->high.z(), 1);
}

TEST(Tessellation, IsWoundOutwardsAndNearlyFillsItsEllipsoid) {
  const auto mesh = tessellate(Ellipsoid{{1, 2, 3}});
  EXPECT_NEAR(volume(*mesh) / (4.0 / 3 * M_PI * 6), 1, 0.01);
}

TEST(ConvexHull, OfAFinelyDividedBoxHasItsEightCorners) {
  // Each face of the cube in 10 x 10 squares.
  TriangleMesh mesh;
  constexpr std::uint32_t kSide = 11;
  for (int face = 0; face < 6; ++face) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
      TriangleMesh::Point point{};
      const auto axis = static_cast<std::size_t>(face / 2);
      point[axis] = face % 2 == 0 ? -0.5F : 0.5F;
      point[(axis + 1) % 3] = static_cast<float>(i % kSide) / 10 - 0.5F;
      point[(axis + 2) % 3] = static_cast<float>(i / kSide) / 10 - 0.5F;
      mesh.vertices.push_back(point);
    }
    for (std::uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i) {
      if (i % kSide == kSide - 1) continue;
      const std::uint32_t a = first + i;
      mesh.triangles.push_back({a, a + 1, a + kSide});
      mesh.triangles.push_back({a + 1, a + kSide + 1, a + kSide});
    }
  }
  const Hull hull = convex_hull(mesh);
  EXPECT_EQ(hull.corners.size(), 8U);
  EXPECT_NEAR(enclosed_volume(hull.triangles, [&](std::uint32_t i) { return hull.corners[i]; }), 1, 1e-6);
}

TEST(ConvexHull, OfAFlatSurfaceIsNothing) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_TRUE(convex_hull(mesh).triangles.empty());
}

}  // namespace
}  // namespace bubblesim::test::test_meshes
