// SPDX-License-Identifier: BSD-3-Clause
// ball: the child rotates about a point.
#include "physics/joints/define.hpp"

namespace bubblesim {
namespace {

class Ball final : public Joint {
 public:
  Ball(dWorldID world, const JointSite& site) : Joint({}), joint_(dJointCreateBall(world, nullptr)) {
    dJointAttach(joint_.get(), site.child, site.parent);
    dJointSetBallAnchor(joint_.get(), site.pose.position.x(), site.pose.position.y(), site.pose.position.z());
  }

  double position(int) const override { return 0; }
  double velocity(int) const override { return 0; }

 private:
  ode::JointHandle joint_;
};

}  // namespace

class BallKind final : public JointKind {
 public:
  BallKind() : JointKind("ball", 0) { swings = true; }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription&, const JointSite& site) const override {
    return std::make_unique<Ball>(world, site);
  }
};

template const JointKind& joint_kind<BallKind>();

}  // namespace bubblesim
