// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bubblesim/error.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"

namespace bubblesim::test::test_ray_shapes {
namespace {

constexpr double kFar = 1000;

/// Casts rays at one static shape in an otherwise empty world.
std::optional<RayHit> hit(const Geometry& geometry, const Vector3& origin, const Vector3& direction,
                          double max_distance = kFar, const Pose& pose = {}) {
  const World world(scene({still(model("Target", link_with(geometry), pose))}), 0);
  return world.geometry().cast_ray(origin, direction.normalized(), max_distance);
}

void expect_hit(const std::optional<RayHit>& found, double distance, const Vector3& normal) {
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, distance, 1e-12 * (1 + distance));
  EXPECT_LT((found->normal - normal).norm(), 1e-12);
}

const Box kBox{{2, 4, 6}};
const Sphere kSphere{2};
const Cylinder kCylinder{1, 4};
const Plane kPlane{};
const Capsule kCapsule{1, 4};
const Ellipsoid kEllipsoid{{1, 2, 3}};
const Mesh kMesh = box_mesh(kBox.size);

TEST(RayOnBox, MeetsTheFacesHeadOn) {
  expect_hit(hit(kBox, {5, 0.5, -1}, {-1, 0, 0}), 4, {1, 0, 0});
  expect_hit(hit(kBox, {0.9, -7, 2.9}, {0, 1, 0}), 5, {0, -1, 0});
  expect_hit(hit(kBox, {0, 0, 10}, {0, 0, -1}), 7, {0, 0, 1});
}

TEST(RayOnBox, MeetsTheFirstFaceOfAnObliqueRay) {
  // From (4, 0, 0) down to the face x = 1 along (-3, 1, 0): 3 of x take 1 of y, within the face.
  expect_hit(hit(kBox, {4, 0, 0}, {-3, 1, 0}), std::sqrt(10.0), {1, 0, 0});
}

TEST(RayOnBox, PassesBesideTheFaces) {
  EXPECT_FALSE(hit(kBox, {5, 2.001, 0}, {-1, 0, 0}));
  EXPECT_FALSE(hit(kBox, {5, 0, 3.001}, {-1, 0, 0}));
  EXPECT_FALSE(hit(kBox, {4, 0, 0}, {-1, 1, 0}));
}

TEST(RayOnSphere, MeetsItAtTheClosedForm) {
  expect_hit(hit(kSphere, {5, 0, 0}, {-1, 0, 0}), 3, {1, 0, 0});
  // One metre off the axis: the near point has x = sqrt(r^2 - 1).
  const double x = std::sqrt(3.0);
  expect_hit(hit(kSphere, {5, 1, 0}, {-1, 0, 0}), 5 - x, {x / 2, 0.5, 0});
}

TEST(RayOnSphere, PassesBesideIt) { EXPECT_FALSE(hit(kSphere, {5, 2.000001, 0}, {-1, 0, 0})); }

TEST(RayOnSphere, TangentTouchesAtOnePoint) { expect_hit(hit(kSphere, {5, 2, 0}, {-1, 0, 0}), 5, {0, 1, 0}); }

TEST(RayOnCylinder, MeetsItsSide) {
  expect_hit(hit(kCylinder, {5, 0, 1.5}, {-1, 0, 0}), 4, {1, 0, 0});
  const double x = std::sqrt(0.75);
  expect_hit(hit(kCylinder, {5, 0.5, 0}, {-1, 0, 0}), 5 - x, {x, 0.5, 0});
}

TEST(RayOnCylinder, MeetsItsCaps) {
  expect_hit(hit(kCylinder, {0.3, 0.4, 10}, {0, 0, -1}), 8, {0, 0, 1});
  // Passes above the rim, 45 degrees down, and hits the cap half a metre from its centre.
  expect_hit(hit(kCylinder, {-2.5, 0, 4}, {1, 0, -1}), 2 * std::sqrt(2.0), {0, 0, 1});
}

TEST(RayOnCylinder, ParallelToItsAxisMeetsTheCapOrNothing) {
  expect_hit(hit(kCylinder, {0.999, 0, -9}, {0, 0, 1}), 7, {0, 0, -1});
  EXPECT_FALSE(hit(kCylinder, {1.001, 0, -9}, {0, 0, 1}));
}

TEST(RayOnCylinder, PassesOverTheCaps) { EXPECT_FALSE(hit(kCylinder, {5, 0, 2.001}, {-1, 0, 0})); }

TEST(RayOnCapsule, MeetsItsSideAndItsRoundEnds) {
  expect_hit(hit(kCapsule, {5, 0, 1.9}, {-1, 0, 0}), 4, {1, 0, 0});
  expect_hit(hit(kCapsule, {0, 0, 9}, {0, 0, -1}), 6, {0, 0, 1});
  // 0.6 m off the axis the end is 0.8 m high; 2.6 m up it is 0.8 m wide.
  expect_hit(hit(kCapsule, {0, 0.6, -9}, {0, 0, 1}), 9 - 2.8, {0, 0.6, -0.8});
  expect_hit(hit(kCapsule, {5, 0, 2.6}, {-1, 0, 0}), 5 - 0.8, {0.8, 0, 0.6});
  EXPECT_FALSE(hit(kCapsule, {5, 0, 3.001}, {-1, 0, 0}));
}

TEST(RayOnEllipsoid, MeetsItAtTheClosedForm) {
  expect_hit(hit(kEllipsoid, {5, 0, 0}, {-1, 0, 0}), 4, {1, 0, 0});
  expect_hit(hit(kEllipsoid, {0, 0, -9}, {0, 0, 1}), 6, {0, 0, -1});
  // At y = 1.2 the ellipse x^2 + y^2 / 4 = 1 has x = 0.8; its normal there is (x, y / 4).
  expect_hit(hit(kEllipsoid, {5, 1.2, 0}, {-1, 0, 0}), 4.2, Vector3(0.8, 0.3, 0).normalized());
  EXPECT_FALSE(hit(kEllipsoid, {5, 2.001, 0}, {-1, 0, 0}));
}

TEST(RayOnMesh, MeetsItsTrianglesFromTheirFrontAlone) {
  expect_hit(hit(kMesh, {4, 0, 0}, {-3, 1, 0}), std::sqrt(10.0), {1, 0, 0});
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  const Mesh flat{finish_mesh(sheet)};
  expect_hit(hit(flat, {0.2, 0.2, 3}, {0, 0, -1}), 3, {0, 0, 1});
  EXPECT_FALSE(hit(flat, {0.2, 0.2, -3}, {0, 0, 1}));
  EXPECT_FALSE(hit(flat, {0.6, 0.6, 3}, {0, 0, -1}));
}

TEST(RayOnPlane, MeetsItFromAbove) {
  expect_hit(hit(kPlane, {1, 2, 3}, {0, 0, -1}), 3, {0, 0, 1});
  expect_hit(hit(kPlane, {0, 0, 3}, {3, 4, -5}), 3 * std::sqrt(2.0), {0, 0, 1});
  expect_hit(hit(Plane{{0, 3, 4}}, {0, 0, 10}, {0, 0, -1}), 10, {0, 0.6, 0.8});
}

TEST(RayOnPlane, IsSolidBelow) { EXPECT_FALSE(hit(kPlane, {0, 0, -1}, {0, 0, 1})); }

TEST(RayOnPlane, ParallelOrRisingRaysMissIt) {
  EXPECT_FALSE(hit(kPlane, {0, 0, 1}, {1, 0, 0}));
  EXPECT_FALSE(hit(kPlane, {0, 0, 1}, {1, 0, 0.001}));
}

class RayOnAnyShape : public ::testing::TestWithParam<Geometry> {};

TEST_P(RayOnAnyShape, DoesNotSeeItFromInside) {
  EXPECT_FALSE(hit(GetParam(), {0, 0, -0.01}, {1, 0, 0}));
  EXPECT_FALSE(hit(GetParam(), {0, 0, -0.01}, {0, 0, 1}));
  EXPECT_FALSE(hit(GetParam(), {0, 0, -0.01}, {0.3, -0.7, 0.2}));
}

TEST_P(RayOnAnyShape, DoesNotSeeWhatLiesBehind) { EXPECT_FALSE(hit(GetParam(), {0, 0, 10}, {0, 0, 1})); }

TEST_P(RayOnAnyShape, EndsAtItsLength) {
  const auto found = hit(GetParam(), {0, 0, 10}, {0, 0, -1});
  ASSERT_TRUE(found);
  EXPECT_TRUE(hit(GetParam(), {0, 0, 10}, {0, 0, -1}, found->distance + 1e-9));
  EXPECT_FALSE(hit(GetParam(), {0, 0, 10}, {0, 0, -1}, found->distance - 1e-9));
}

TEST_P(RayOnAnyShape, FollowsItsPose) {
  if (std::holds_alternative<Plane>(GetParam())) return;  // looks the same from most sides
  const Pose moved(Vector3(3, -2, 7), from_rpy(0.4, -1.1, 2.5));
  const Vector3 origin(0.2, 0.1, 10);
  const Vector3 direction(0.01, -0.02, -1);
  const auto here = hit(GetParam(), origin, direction);
  const auto there = hit(GetParam(), moved * origin, moved.orientation * direction, kFar, moved);
  ASSERT_TRUE(here && there);
  EXPECT_NEAR(here->distance, there->distance, 1e-9);
  EXPECT_LT((moved.orientation * here->normal - there->normal).norm(), 1e-9);
}

/// Below zero inside the shape, above zero outside; not a distance.
double outside(const Geometry& geometry, const Vector3& p) {
  if (const auto* box = std::get_if<Box>(&geometry)) {
    return std::max({std::abs(p.x()) - box->size.x() / 2, std::abs(p.y()) - box->size.y() / 2,
                     std::abs(p.z()) - box->size.z() / 2});
  }
  if (std::holds_alternative<Mesh>(geometry)) return outside(kBox, p);
  if (const auto* capsule = std::get_if<Capsule>(&geometry)) {
    const double half = capsule->length / 2;
    return (p - Vector3(0, 0, std::clamp(p.z(), -half, half))).norm() - capsule->radius;
  }
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&geometry)) return p.cwiseQuotient(ellipsoid->radii).norm() - 1;
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) return p.norm() - sphere->radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    return std::max(std::hypot(p.x(), p.y()) - cylinder->radius, std::abs(p.z()) - cylinder->length / 2);
  }
  return std::get<Plane>(geometry).normal.dot(p);
}

TEST_P(RayOnAnyShape, AgreesWithSamplingAlongRandomRays) {
  const Geometry& geometry = GetParam();
  const World world(scene({still(model("Target", link_with(geometry)))}), 0);
  std::mt19937 random(42);
  std::uniform_real_distribution<double> place(-6, 6);
  std::normal_distribution<double> any;
  constexpr double kReach = 15;
  constexpr int kSamples = 1500;
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3 origin(place(random), place(random), place(random));
    const Vector3 direction = Vector3(any(random), any(random), any(random)).normalized();
    if (outside(geometry, origin) <= 0) continue;
    const auto found = world.geometry().cast_ray(origin, direction, kReach);
    if (found) {
      ++hits;
      const Vector3 point = origin + direction * found->distance;
      EXPECT_NEAR(outside(geometry, point), 0, 1e-9) << "on the surface";
      EXPECT_GT(outside(geometry, point + found->normal * 1e-6), 0) << "the normal points outwards";
      EXPECT_LE(found->normal.dot(direction), 1e-12) << "the ray enters";
    }
    const double end = found ? found->distance : kReach;
    for (int s = 0; s < kSamples; ++s) {
      ASSERT_GT(outside(geometry, origin + direction * (end * s / kSamples)), -1e-9) << "no earlier point is inside";
    }
  }
  EXPECT_GT(hits, 10);
}

INSTANTIATE_TEST_SUITE_P(Shapes, RayOnAnyShape,
                         ::testing::Values(kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kPlane, kMesh));

TEST(RayInAWorld, NearestOfSeveralShapesCountsAndModelsCanBeLeftOut) {
  const World world(scene({still(model("Near", link_with(Sphere{1}), at(5, 0, 0))),
                           still(model("Far", link_with(Sphere{1}), at(9, 0, 0)))}),
                    0);
  const auto near = world.geometry().cast_ray({}, Vector3::UnitX(), kFar);
  ASSERT_TRUE(near);
  EXPECT_DOUBLE_EQ(near->distance, 4);
  EXPECT_EQ(world.tree().path(near->link), "/Near/link");
  const auto far = world.geometry().cast_ray({}, Vector3::UnitX(), kFar, world.tree().find("/Near"));
  ASSERT_TRUE(far);
  EXPECT_DOUBLE_EQ(far->distance, 8);
}

TEST(RayInAWorld, SeesABodyWhereItHasMovedTo) {
  World world(scene({model("Ball", link_with(Sphere{1}), at(5, 0, 0))}), 0);
  world.set_pose(world.tree().find("/Ball"), at(0, 8, 0));
  EXPECT_FALSE(world.geometry().cast_ray({}, Vector3::UnitX(), kFar));
  const auto found = world.geometry().cast_ray({}, Vector3::UnitY(), kFar);
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->distance, 7);
}

}  // namespace
}  // namespace bubblesim::test::test_ray_shapes
