// SPDX-License-Identifier: BSD-3-Clause
// Frames of a run.
#include <gtest/gtest.h>

#include <memory>

#include "bubblesim/runner.hpp"
#include "runs.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_frame {
namespace {

TEST_F(Run, FramesShowTheStateAfterTheStep) {
  make(fast());
  EXPECT_EQ(runner->frame()->time, 0);
  runner->run_in_background();
  runner->step(10).get();
  const std::shared_ptr<const Frame> frame = runner->frame();
  EXPECT_DOUBLE_EQ(frame->time, 0.5);
  ASSERT_EQ(frame->poses.size(), 1U);
  // Semi-implicit Euler: after n substeps of h, z = -g h^2 n (n + 1) / 2.
  const double fallen = kGravity * kSubstep * kSubstep * 100 * 101 / 2;
  EXPECT_NEAR(frame->poses[0][2], -fallen, 1e-5);
  EXPECT_EQ(frame->poses[0][6], 1) << "w of the quaternion";
  EXPECT_EQ(runner->frame()->layout, frame->layout) << "shared until models come or go";
  runner->call([&] { simulation.add_model(model("Second", link("link"), at(0, 0, 5))); }).get();
  EXPECT_NE(runner->frame()->layout->revision, frame->layout->revision);
  EXPECT_EQ(runner->frame()->poses.size(), 2U);
  EXPECT_EQ(frame->poses.size(), 1U) << "a frame does not change";
}

TEST_F(Run, FramesLeaveOutStaticLinks) {
  SceneDescription with_floor = scene({floor(), model("Ball", link("link"))});
  Simulation other{with_floor, 1};
  EXPECT_EQ(Runner(other).frame()->poses.size(), 1U);
}

}  // namespace
}  // namespace bubblesim::test::test_frame
