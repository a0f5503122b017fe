// SPDX-License-Identifier: BSD-3-Clause
#include "scene/unit_rotations.hpp"

#include <cmath>

namespace bubblesim {
namespace {

void make_unit(Pose& pose) {
  constexpr double kRounding = 1e-14;
  if (std::abs(pose.orientation.squaredNorm() - 1) > kRounding) pose.orientation.normalize();
}

template <class Parts>
void make_each_unit(Parts& parts) {
  for (auto& part : parts) make_unit(part.pose);
}

}  // namespace

void make_rotations_unit(ModelDescription& model) {
  make_unit(model.pose);
  make_each_unit(model.nested);
  for (LinkDescription& link : model.links) {
    make_unit(link.pose);
    if (link.start) make_unit(*link.start);
    make_each_unit(link.collisions);
    make_each_unit(link.visuals);
    make_each_unit(link.sensors);
  }
  for (JointDescription& joint : model.joints) {
    make_unit(joint.pose);
    make_each_unit(joint.sensors);
  }
}

}  // namespace bubblesim
