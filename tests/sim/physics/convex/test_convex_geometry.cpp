// SPDX-License-Identifier: BSD-3-Clause
// Convex shapes: hulls of known polyhedra, distances, penetration depths and contact points, against exact geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "physics/convex/gjk.hpp"
#include "physics/convex/manifold.hpp"
#include "physics/convex/penetration.hpp"
#include "physics/ode/ode_handles.hpp"
#include "polyhedra.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_convex_geometry {
namespace {

ConvexPart part_of(const std::vector<Vector3>& corners) { return make_part(convex_hull(*hull_mesh(corners))); }

double volume(const ConvexPart& part) {
  double sum = 0;
  for (const ConvexPart::Face& face : part.faces) {
    for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
      const Vector3& a = part.corners[part.loops[face.first]];
      const Vector3& b = part.corners[part.loops[face.first + i]];
      const Vector3& c = part.corners[part.loops[face.first + i + 1]];
      sum += a.dot(b.cross(c)) / 6;
    }
  }
  return sum;
}

TEST(ConvexPart, HasTheFacesOfThePlatonicSolids) {
  // Volumes with corners on a sphere of radius r: Coxeter, Regular Polytopes, table I.
  const double r = 0.3;
  struct Solid {
    std::vector<Vector3> corners;
    std::size_t faces;
    std::uint32_t sides;
    double volume;
  };
  const std::vector<Solid> solids = {{tetrahedron(r), 4, 3, 8 * std::sqrt(3.0) / 27 * r * r * r},
                                     {cube(2 * r / std::sqrt(3.0)), 6, 4, std::pow(2 * r / std::sqrt(3.0), 3)},
                                     {octahedron(r), 8, 3, 4.0 / 3 * r * r * r},
                                     {icosahedron(r), 20, 3, 2.5361507101204 * r * r * r}};
  for (const Solid& solid : solids) {
    const ConvexPart part = part_of(solid.corners);
    EXPECT_EQ(part.corners.size(), solid.corners.size());
    ASSERT_EQ(part.faces.size(), solid.faces);
    for (const ConvexPart::Face& face : part.faces) EXPECT_EQ(face.count, solid.sides);
    EXPECT_NEAR(volume(part), solid.volume, 1e-6 * solid.volume);  // corners are floats
  }
}

TEST(ConvexPart, FindsTheFarthestCornerOfManyAsASearchOfAllDoes) {
  const auto ellipsoid = tessellate(Ellipsoid{{0.3, 0.2, 0.1}});
  const ConvexPart part = make_part(convex_hull(*ellipsoid));
  EXPECT_GT(part.corners.size(), 600U);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 direction{normal(random), normal(random), normal(random)};
    double most = -1;
    for (const Vector3& corner : part.corners) most = std::max(most, corner.dot(direction));
    EXPECT_NEAR(part.corners[part.farthest(direction, 0)].dot(direction), most, 1e-12);
  }
}

TEST(CoreDistance, IsThatOfCubesAtCornersEdgesAndFaces) {
  const ConvexPart unit_cube = part_of(cube(1));
  const ConvexShape fixed(unit_cube, {});
  const auto distance = [&](const Vector3& offset) {
    return core_distance(fixed, ConvexShape(unit_cube, Transform(Pose(offset, Quaternion())))).distance;
  };
  EXPECT_NEAR(distance({1.25, 0.3, 0.2}), 0.25, 1e-12);
  EXPECT_NEAR(distance({1.3, 0.1, 1.4}), 0.5, 1e-12);
  EXPECT_NEAR(distance({1.1, 1.2, 1.2}), 0.3, 1e-12);
}

TEST(Penetration, OfCubesIsTheLeastOverlapOfTheirFaces) {
  const ConvexPart unit_cube = part_of(cube(1));
  const ConvexShape fixed(unit_cube, {});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> offset(-0.99, 0.99);
  for (int i = 0; i < 300; ++i) {
    const Vector3 by{offset(random), offset(random), offset(random)};
    const ConvexShape moved(unit_cube, Transform(at(by.x(), by.y(), by.z())));
    const auto found = penetration(moved, fixed);
    ASSERT_TRUE(found);
    const double expected = 1 - std::max({std::abs(by.x()), std::abs(by.y()), std::abs(by.z())});
    EXPECT_NEAR(found->depth, expected, 1e-9) << by.x() << " " << by.y() << " " << by.z();
    EXPECT_GT(found->normal.dot(by), 0) << "into the first shape";
  }
}

/// The least overlap over the normals of all faces and the cross products of all edges: exact for polytopes.
double least_overlap(const ConvexPart& a, const Transform& of_a, const ConvexPart& b, const Transform& of_b) {
  std::vector<Vector3> directions;
  const auto edges = [](const ConvexPart& part, const Transform& frame) {
    std::vector<Vector3> found;
    for (const ConvexPart::Face& face : part.faces) {
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::uint32_t next = (i + 1) % face.count;
        found.push_back(frame.rotation *
                        (part.corners[part.loops[face.first + next]] - part.corners[part.loops[face.first + i]]));
      }
    }
    return found;
  };
  for (const ConvexPart::Face& face : a.faces) directions.push_back(-(of_a.rotation * face.normal));
  for (const ConvexPart::Face& face : b.faces) directions.push_back(of_b.rotation * face.normal);
  for (const Vector3& x : edges(a, of_a)) {
    for (const Vector3& y : edges(b, of_b)) {
      if (x.cross(y).norm() > 1e-9) directions.push_back(x.cross(y).normalized());
    }
  }
  double least = 1e9;
  for (const Vector3& direction : directions) {
    least = std::min(least, depth_along(ConvexShape(a, of_a), ConvexShape(b, of_b), direction));
  }
  return least;
}

TEST(Penetration, OfTurnedPolyhedraIsThatOfTheSeparatingAxes) {
  const std::vector<ConvexPart> parts = {part_of(tetrahedron(0.3)), part_of(cube(0.4)), part_of(icosahedron(0.25)),
                                         part_of(octahedron(0.3))};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  int overlapping = 0;
  for (int i = 0; i < 600; ++i) {
    const ConvexPart& a = parts[static_cast<std::size_t>(i) % 4];
    const ConvexPart& b = parts[static_cast<std::size_t>(i / 4) % 4];
    const Transform of_a =
        Transform(Pose(place(random), place(random), place(random), angle(random), angle(random), angle(random)));
    const Transform of_b =
        Transform(Pose(place(random), place(random), place(random), angle(random), angle(random), angle(random)));
    const double expected = least_overlap(a, of_a, b, of_b);
    const auto found = penetration(ConvexShape(a, of_a), ConvexShape(b, of_b));
    ASSERT_EQ(found.has_value(), expected > 0) << i << " " << expected;
    if (!found) continue;
    ++overlapping;
    EXPECT_NEAR(found->depth, expected, 1e-3 * expected + 1e-7) << i;
  }
  EXPECT_GT(overlapping, 200);
}

TEST(Penetration, OfABallIsItsRadiusLessTheDistance) {
  const ConvexPart unit_cube = part_of(cube(1));
  const ConvexShape fixed(unit_cube, {});
  const ode::GeomHandle ball(dCreateSphere(nullptr, 0.2));
  const auto depth = [&](double x, double y, double z) {
    dGeomSetPosition(ball.get(), x, y, z);
    const auto found = penetration(ConvexShape(ball.get()), fixed);
    return found ? found->depth : 0;
  };
  EXPECT_NEAR(depth(0.1, 0.2, 0.65), 0.05, 1e-12);
  EXPECT_NEAR(depth(0.1, 0.6, 0.6), 0.2 - std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(depth(0.6, 0.6, 0.6), 0.2 - std::sqrt(0.03), 1e-12);
  EXPECT_NEAR(depth(0.1, 0.2, 0.4), 0.3, 1e-9) << "with its centre inside";
  EXPECT_EQ(depth(0.7, 0.7, 0.7), 0);
}

std::vector<ManifoldPoint> manifold(const ConvexShape& a, const ConvexShape& b) {
  std::vector<ManifoldPoint> points;
  if (const auto overlap = penetration(a, b)) add_manifold(a, b, *overlap, points);
  return points;
}

TEST(Manifold, OfOffsetCubesHasTheCornersOfTheOverlapOfTheirFaces) {
  const ConvexPart small = part_of(cube(0.2));
  const double deep = 0.0005;
  const auto points = manifold(ConvexShape(small, Transform(at(0.05, 0.03, 0.2 - deep))), ConvexShape(small, {}));
  ASSERT_EQ(points.size(), 4U);
  std::set<std::pair<long, long>> places;  // 0.1 mm
  for (const ManifoldPoint& point : points) {
    EXPECT_NEAR(point.depth, deep, 1e-7);
    EXPECT_NEAR(point.normal.z(), 1, 1e-9);
    EXPECT_NEAR(point.at.z(), 0.1 - deep / 2, 1e-7);
    places.insert({std::lround(point.at.x() * 1e4), std::lround(point.at.y() * 1e4)});
  }
  EXPECT_EQ(places, (std::set<std::pair<long, long>>{{-500, -700}, {-500, 1000}, {1000, -700}, {1000, 1000}}));
}

TEST(Manifold, OfATurnedCubeIsTheOctagonOfBothFaces) {
  // A square on one of the same size, turned by 45 degrees: a regular octagon with an inscribed circle of half a side.
  const ConvexPart small = part_of(cube(0.2));
  const auto points =
      manifold(ConvexShape(small, Transform(Pose(0, 0, 0.1995, 0, 0, M_PI / 4))), ConvexShape(small, {}));
  ASSERT_EQ(points.size(), 8U);
  for (const ManifoldPoint& point : points) {
    EXPECT_NEAR(std::hypot(point.at.x(), point.at.y()), 0.1 / std::cos(M_PI / 8), 1e-6);
  }
}

TEST(Manifold, OfCrossedEdgesIsOnePoint) {
  // The upper cube stands on an edge along x, the lower one lies with an edge along y on top.
  const ConvexPart small = part_of(cube(0.2));
  const double half_diagonal = 0.1 * std::sqrt(2.0);
  const auto points =
      manifold(ConvexShape(small, Transform(Pose(0.01, 0.02, 2 * half_diagonal - 0.001, M_PI / 4, 0, 0))),
               ConvexShape(small, Transform(Pose(0, 0, 0, 0, M_PI / 4, 0))));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].depth, 0.001, 1e-6);
  EXPECT_NEAR(points[0].normal.z(), 1, 1e-6);
  EXPECT_NEAR(points[0].at.x(), 0, 1e-6);
  EXPECT_NEAR(points[0].at.y(), 0.02, 1e-6);
}

TEST(Manifold, OfALyingCylinderIsItsLine) {
  const ConvexPart plate = part_of(cube(1));
  const ode::GeomHandle roller(dCreateCylinder(nullptr, 0.1, 0.4));
  dMatrix3 turned;
  dRFromAxisAndAngle(turned, 0, 1, 0, M_PI / 2);
  dGeomSetRotation(roller.get(), turned);
  dGeomSetPosition(roller.get(), 0.1, 0, 0.5995);
  const auto points = manifold(ConvexShape(roller.get()), ConvexShape(plate, {}));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_NEAR(std::abs(points[0].at.x() - points[1].at.x()), 0.4, 1e-9);
  for (const ManifoldPoint& point : points) EXPECT_NEAR(point.depth, 0.0005, 1e-7);
}

}  // namespace
}  // namespace bubblesim::test::test_convex_geometry
