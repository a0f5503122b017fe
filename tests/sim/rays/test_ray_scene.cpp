// SPDX-License-Identifier: BSD-3-Clause
// Single-precision rays compared with the exact rays of World::cast_ray.
#include <gtest/gtest.h>

#include <random>

#include "rays/ray_scene.hpp"
#include "scenes.hpp"
#include "surfaces.hpp"
#include "traced.hpp"

namespace bubblesim::test::test_ray_scene {
namespace {

constexpr double kExact = 1e-4;  // m
constexpr double kFar = Traced::kFar;

void expect_hit(const std::optional<RayHit>& found, double distance, const Vector3& normal, ObjectId link) {
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, distance, kExact);
  EXPECT_LT((found->normal - normal).norm(), 1e-5);
  EXPECT_EQ(found->link, link);
}

const Box kBox{{2, 4, 6}};

class RayOnMovingAndStill : public ::testing::TestWithParam<bool> {
 protected:
  static Traced one(const Geometry& geometry, const Pose& pose = {}) {
    ModelDescription target = model("Target", link_with(geometry), pose);
    target.is_static = GetParam();
    return Traced(scene({target}));
  }
};

TEST_P(RayOnMovingAndStill, MeetsEachFaceOfABoxFromOutside) {
  const Traced traced = one(kBox);
  const ObjectId link = traced.find("/Target/link");
  for (const Vector3& face : {Vector3(1, 0, 0), Vector3(0, 2, 0), Vector3(0, 0, 3)}) {
    for (const double side : {1.0, -1.0}) {
      const Vector3 normal = face.normalized() * side;
      expect_hit(traced.hit(normal * 10, -normal), 10 - face.norm(), normal, link);
    }
  }
}

TEST_P(RayOnMovingAndStill, DoesNotSeeAShapeFromInside) {
  for (const Geometry& geometry :
       {Geometry(kBox), Geometry(Sphere{1}), Geometry(Cylinder{1, 2}), Geometry(Capsule{1, 2}),
        Geometry(Ellipsoid{{1, 2, 3}}), Geometry(box_mesh({2, 4, 6}))}) {
    EXPECT_FALSE(one(geometry).hit({0.1, 0.2, 0.3}, Vector3(1, 2, 3).normalized()));
  }
}

TEST_P(RayOnMovingAndStill, FromInsideAShapeSeesWhatStandsOutside) {
  ModelDescription housing = model("Housing", link_with(kBox));
  housing.is_static = GetParam();
  const Traced traced(scene({housing, still(model("Wall", link_with(Box{{1, 9, 9}}), at(5.5, 0, 0)))}));
  expect_hit(traced.hit({0, 0, 0.5}, Vector3::UnitX()), 5, {-1, 0, 0}, traced.find("/Wall/link"));
}

TEST_P(RayOnMovingAndStill, EndsAtItsLength) {
  EXPECT_TRUE(one(Sphere{1}, at(kFar + 0.9, 0, 0)).hit({}, Vector3::UnitX()));
  EXPECT_FALSE(one(Sphere{1}, at(kFar + 1.1, 0, 0)).hit({}, Vector3::UnitX()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, RayOnMovingAndStill, ::testing::Bool());

TEST(RayScene, WithoutAnythingIsEmpty) {
  const Traced traced(scene({}));
  EXPECT_FALSE(traced.hit({}, Vector3::UnitX()));
  EXPECT_TRUE(traced.lit({}, Vector3::UnitX()));
}

TEST(RayScene, HasItsInfinitePlanesSolidBelow) {
  const Traced traced(scene({floor()}));
  expect_hit(traced.hit({0, 0, 3}, Vector3(3, 4, -5).normalized()), 3 * std::sqrt(2.0), {0, 0, 1},
             traced.find("/Floor/link"));
  EXPECT_FALSE(traced.hit({0, 0, 3}, Vector3::UnitX()));
  EXPECT_FALSE(traced.hit({0, 0, -1}, Vector3::UnitZ()));
}

/// Random rays; those that only touch an edge may or may not hit.
void expect_as_exact_rays(const Traced& traced, std::mt19937& random, ObjectId ignored) {
  std::uniform_real_distribution<double> place(-12, 12);
  std::normal_distribution<double> any;
  int hits = 0;
  int differing = 0;
  for (int i = 0; i < 4000; ++i) {
    // Origins that are exact in single precision: the exact ray is then the same.
    const Vector3 origin(static_cast<float>(place(random)), static_cast<float>(place(random)),
                         static_cast<float>(place(random) + 8));
    const Vector3 direction = Vector3(any(random), any(random), any(random)).normalized();
    const auto exact = traced.world.geometry().cast_ray(origin, direction, kFar, ignored);
    const auto traced_hit = traced.hit(origin, direction, ignored, i % 2 == 0);
    if (exact.has_value() != traced_hit.has_value() || (exact && exact->link != traced_hit->link)) {
      ++differing;
      continue;
    }
    if (!exact) continue;
    ++hits;
    const double grazing = std::abs(exact->normal.dot(direction));
    if (grazing < 0.01) continue;
    EXPECT_NEAR(traced_hit->distance, exact->distance, kExact);
    EXPECT_LT((traced_hit->normal - exact->normal).norm(), 1e-3);
  }
  EXPECT_GT(hits, 400);
  EXPECT_LE(differing, 2);
}

TEST(RayScene, AgreesWithExactRaysAmongAllShapes) {
  std::mt19937 random(7);
  const Traced traced(clutter(random));
  expect_as_exact_rays(traced, random, kNoObject);
}

TEST(RayScene, AgreesWithExactRaysAmongFewMovingShapes) {
  std::mt19937 random(10);
  const Traced traced(clutter(random, 30));
  expect_as_exact_rays(traced, random, kNoObject);
  expect_as_exact_rays(traced, random, traced.find("/Thing2"));
}

TEST(RayScene, AgreesWithExactRaysThatLeaveOutAModel) {
  std::mt19937 random(8);
  const Traced traced(clutter(random));
  expect_as_exact_rays(traced, random, traced.find("/Floor"));
  expect_as_exact_rays(traced, random, traced.find("/Thing3"));
}

TEST(RayScene, FollowsWhatMoves) {
  std::mt19937 random(9);
  Traced traced(clutter(random));
  std::uniform_real_distribution<double> place(-8, 8);
  for (const ModelDescription& model : traced.scene.models) {
    if (model.is_static) continue;
    const Pose pose(place(random), place(random), place(random) + 8, 1, place(random), 2);
    traced.world.set_pose(traced.find(("/" + model.name).c_str()), pose);
  }
  traced.rays.refresh(traced.world);
  expect_as_exact_rays(traced, random, kNoObject);
}

TEST(RayScene, LosesWhatIsRemovedAndTakesItBack) {
  const ModelDescription ball = model("Ball", link_with(Sphere{1}), at(5, 0, 0));
  const ModelDescription wall = still(model("Wall", link_with(Box{{1, 9, 9}}), at(8.5, 0, 0)));
  Traced traced(scene({floor(), ball, wall}, Vector3::Zero()));
  const Vector3 eye(0, 0, 0.5);
  const auto seen = [&] {
    traced.rays.refresh(traced.world);
    const auto hit = traced.hit(eye, Vector3::UnitX());
    return hit ? hit->link : kNoObject;
  };
  EXPECT_EQ(seen(), traced.find("/Ball/link"));
  traced.rays.remove_model(traced.find("/Ball"));
  EXPECT_EQ(seen(), traced.find("/Wall/link"));
  traced.rays.remove_model(traced.find("/Wall"));
  EXPECT_EQ(seen(), kNoObject);
  traced.rays.remove_model(traced.find("/Floor"));
  EXPECT_FALSE(traced.hit(eye, -Vector3::UnitZ()));
  traced.rays.add_model(traced.world, traced.find("/Wall"), wall);
  traced.rays.add_model(traced.world, traced.find("/Ball"), ball);
  EXPECT_EQ(seen(), traced.find("/Ball/link"));
}

TEST(RayScene, ShowsVisualsInPlaceOfCollisionShapes) {
  ModelDescription robot = model("Robot", link_with(Sphere{1}));
  VisualDescription visual;
  visual.geometry = Sphere{2};
  visual.laser_retro = 7;
  robot.links[0].visuals.push_back(visual);
  const Traced traced(scene({robot}));
  const rays::RayPacket packet = traced.trace({10, 0, 0}, -Vector3::UnitX());
  ASSERT_TRUE(packet.hit(0));
  EXPECT_NEAR(packet.data.ray.tfar[0], 8, kExact);
  EXPECT_EQ(traced.rays.shape(packet, 0).laser_retro, 7);
}

TEST(Shadow, FallsFromStillAndMovingShapesAlike) {
  const Traced traced(scene({still(model("Still", link_with(Sphere{1}), at(0, 0, 5))),
                             model("Moving", link_with(Box{{1, 1, 1}}), at(5, 0, 5)), floor()}));
  EXPECT_FALSE(traced.lit({0.5, 0, 0}, Vector3::UnitZ()));
  EXPECT_FALSE(traced.lit({5.4, 0, 0}, Vector3::UnitZ()));
  EXPECT_TRUE(traced.lit({2.5, 0, 0}, Vector3::UnitZ()));
}

}  // namespace
}  // namespace bubblesim::test::test_ray_scene
