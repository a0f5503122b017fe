// SPDX-License-Identifier: BSD-3-Clause
#include "scene/unit_rotations.hpp"

#include <cmath>

namespace bubblesim {
namespace {

template <class Parts>
void make_each_unit(Parts& parts) {
  for (auto& part : parts) make_rotation_unit(part.pose);
}

}  // namespace

void make_rotation_unit(Pose& pose) {
  constexpr double kRounding = 1e-14;
  if (std::abs(pose.orientation.squaredNorm() - 1) > kRounding) pose.orientation.normalize();
}

void make_rotations_unit(ModelDescription& model) {
  make_rotation_unit(model.pose);
  make_each_unit(model.nested);
  make_each_unit(model.frames);
  for (LinkDescription& link : model.links) {
    make_rotation_unit(link.pose);
    if (link.start) make_rotation_unit(*link.start);
    make_each_unit(link.collisions);
    make_each_unit(link.visuals);
    make_each_unit(link.sensors);
  }
  for (JointDescription& joint : model.joints) {
    make_rotation_unit(joint.pose);
    make_each_unit(joint.sensors);
  }
}

}  // namespace bubblesim
