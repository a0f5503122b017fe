// SPDX-License-Identifier: BSD-3-Clause
// prismatic: the child slides along one axis.
#include "physics/joints/define.hpp"

namespace bubblesim {
namespace {

class Slider final : public Joint {
 public:
  Slider(dWorldID world, const JointDescription& description, const JointSite& site)
      : Joint(description.axes), joint_(dJointCreateSlider(world, nullptr)) {
    dJointAttach(joint_.get(), site.child, site.parent);
    const Vector3 direction = axis_direction(description, 0, site);
    dJointSetSliderAxis(joint_.get(), direction.x(), direction.y(), direction.z());
    add_rows(world, Motor(joint_.get(), dJointSetSliderParam, 0), Motion::kSlides,
             {direction, site.child, site.parent});
  }

  double position(int) const override { return dJointGetSliderPosition(joint_.get()); }
  double velocity(int) const override { return dJointGetSliderPositionRate(joint_.get()); }

 private:
  ode::JointHandle joint_;
};

}  // namespace

class PrismaticKind final : public JointKind {
 public:
  PrismaticKind() : JointKind("prismatic", 1) { slides = true; }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Slider>(world, description, site);
  }
};

template const JointKind& joint_kind<PrismaticKind>();

}  // namespace bubblesim
