// SPDX-License-Identifier: BSD-3-Clause
// ball: the child turns about a point.
#include "kinds.hpp"

namespace bubblesim {
namespace {

class Ball final : public Joint {
 public:
  Ball(dWorldID world, const Pose& pose, JointBodies bodies) : Joint({}), joint_(dJointCreateBall(world, nullptr)) {
    dJointAttach(joint_.get(), bodies.child, bodies.parent);
    dJointSetBallAnchor(joint_.get(), pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z());
  }

  double position(int) const override { return 0; }
  double velocity(int) const override { return 0; }

 private:
  void set_stop(int, int, double) override {}
  void set_motor(int, int, double) override {}

  ode::JointHandle joint_;
};

}  // namespace

std::unique_ptr<Joint> make_ball(dWorldID world, const JointDescription&, const Pose& pose, JointBodies bodies) {
  return std::make_unique<Ball>(world, pose, bodies);
}

}  // namespace bubblesim
