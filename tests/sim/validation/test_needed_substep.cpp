// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"
#include "validation/needed_substep.hpp"

namespace bubblesim::test::test_needed_substep {
namespace {

constexpr double kGravity = 9.81;

/// Rods of 1 m and 1 kg on hinges below each other; the last weighs `load`.
ModelDescription chain(double load, MotorMode motor = MotorMode::kNone) {
  ModelDescription made;
  made.name = "Chain";
  for (int i = 0; i < 4; ++i) {
    LinkDescription rod = link("rod" + std::to_string(i), Vector3(0, 0, -i));
    rod.mass = i == 3 ? load : 1;
    rod.inertia_diagonal = {1.0 / 12, 1.0 / 12, 1e-3};
    made.links.push_back(rod);
    made.joints.push_back(joint("revolute", {axis(Vector3::UnitY(), motor)}, Vector3(0, 0, -i),
                                i == 0 ? "world" : "rod" + std::to_string(i - 1), rod.name));
  }
  return made;
}

TEST(NeededSubstep, FollowsFromTheLoadOfAChain) {
  const auto needed = needed_substep(chain(1000), kGravity);
  ASSERT_TRUE(needed);
  // The first rod carries two more and the load: w^2 = 12 T / (m L), with three times the weight.
  EXPECT_EQ(needed->link, "rod0");
  EXPECT_DOUBLE_EQ(needed->load, 1002);
  EXPECT_NEAR(needed->step, 2 / std::sqrt(12 * 3 * 1002 * kGravity), 1e-12);
}

TEST(NeededSubstep, IsNoneForDrivenJointsAndWithoutGravity) {
  EXPECT_FALSE(needed_substep(chain(1000, MotorMode::kPosition), kGravity));
  EXPECT_FALSE(needed_substep(chain(1000), 0));
  EXPECT_FALSE(needed_substep(model("Box", link("link")), kGravity));
}

}  // namespace
}  // namespace bubblesim::test::test_needed_substep
