// SPDX-License-Identifier: BSD-3-Clause
// fixed: child and parent move as one body.
#include "physics/joints/define.hpp"

namespace bubblesim {
namespace {

class Fixed final : public Joint {
 public:
  Fixed(dWorldID world, const JointSite& site) : Joint({}), joint_(dJointCreateFixed(world, nullptr)) {
    dJointAttach(joint_.get(), site.child, site.parent);
    dJointSetFixed(joint_.get());
  }

  double position(int) const override { return 0; }
  double velocity(int) const override { return 0; }
  void place(const Pose&) override { dJointSetFixed(joint_.get()); }

 private:
  ode::JointHandle joint_;
};

}  // namespace

class FixedKind final : public JointKind {
 public:
  FixedKind() : JointKind("fixed", 0) {}

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription&, const JointSite& site) const override {
    return std::make_unique<Fixed>(world, site);
  }
};

template const JointKind& joint_kind<FixedKind>();

}  // namespace bubblesim
