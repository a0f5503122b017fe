// SPDX-License-Identifier: BSD-3-Clause
// The spring of a mouse: what it pulls, and where to.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/point_spring.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_point_spring {
namespace {

/// A body in air, so that it does not turn for ever round the point that holds it.
SceneDescription body_in_air() {
  LinkDescription described = link("link");
  described.angular_decay = 1;
  return scene({model("Body", described)}, Vector3::Zero());
}

class Pulled : public ::testing::Test {
 protected:
  Pulled() { world.devices().add(spring, 0); }

  Vector3 place_of(const Vector3& point) const {
    const Pose pose = world.pose(body);
    return pose.position + pose.orientation * point;
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / simulation.time_step()); ++i) simulation.step();
  }

  Simulation simulation{body_in_air()};
  World& world = simulation.world();
  ObjectId body = world.tree().find("/Body/link");
  std::shared_ptr<PointSpring> spring = std::make_shared<PointSpring>();
};

TEST_F(Pulled, PointOfTheLinkComesToTheTarget) {
  const Vector3 point(0.3, 0.1, 0);
  const Vector3 target(-1, 2, 0.5);
  world.set_velocity(body, {{3, 0, 0}, {0, 0, 2}});
  run(1);  // it is elsewhere and turned by then
  spring->grip(world, body, point);
  spring->pull_to(target);
  run(20);
  EXPECT_LT((place_of(point) - target).norm(), 1e-3);
}

TEST_F(Pulled, LinkStaysWhereItIsUntilTheTargetMoves) {
  const Pose before = world.pose(body);
  spring->grip(world, body, {0.3, 0.1, 0});
  run(1);
  EXPECT_LT((world.pose(body).position - before.position).norm(), 1e-9);
}

TEST_F(Pulled, PlacesThatAreNotFiniteAreRefused) {
  EXPECT_THROW(spring->grip(world, body, {0, kInfinity, 0}), InvalidInput);
  spring->grip(world, body, {});
  EXPECT_THROW(spring->pull_to({kInfinity, 0, 0}), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_point_spring
