// SPDX-License-Identifier: BSD-3-Clause
// fixed: child and parent move as one.
#include "kinds.hpp"

namespace bubblesim {
namespace {

class Fixed final : public Joint {
 public:
  Fixed(dWorldID world, JointBodies bodies) : Joint({}), joint_(dJointCreateFixed(world, nullptr)) {
    dJointAttach(joint_.get(), bodies.child, bodies.parent);
    dJointSetFixed(joint_.get());
  }

  double position(int) const override { return 0; }
  double velocity(int) const override { return 0; }

 private:
  void set_stop(int, int, double) override {}
  void set_motor(int, int, double) override {}

  ode::JointHandle joint_;
};

}  // namespace

std::unique_ptr<Joint> make_fixed(dWorldID world, const JointDescription&, const Pose&, JointBodies bodies) {
  return std::make_unique<Fixed>(world, bodies);
}

}  // namespace bubblesim
