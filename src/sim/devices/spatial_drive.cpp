// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/spatial_drive.hpp"

#include <cstddef>

#include "bubblesim/error.hpp"
#include "bubblesim/state_archive.hpp"
#include "validation/limits.hpp"

namespace bubblesim {

SpatialDrive::SpatialDrive(const World& world, ObjectId object) : object_(object) {
  const SceneTree& tree = world.tree();
  const ObjectKind kind = tree.at(object).kind;
  if (kind != ObjectKind::kModel && kind != ObjectKind::kLink) {
    throw WrongObject(tree.short_path(object) + " is a " + std::string(kind_name(kind)) +
                      ": a drive moves a model or a link");
  }
  if (world.models().description(object).is_static) {
    throw WrongObject(tree.short_path(object) + " is static: it cannot be moved");
  }
  if (kind == ObjectKind::kModel) links_ = tree.parts(object, ObjectKind::kLink);
  if (kind == ObjectKind::kLink) links_ = {object};
}

void SpatialDrive::set_velocity(const Twist& velocity) {
  if (!within(velocity.linear.norm(), kMaxSpeed) || !within(velocity.angular.norm(), kMaxSpeed)) {
    throw InvalidInput("the velocity of a drive must be finite and at most 1e6");
  }
  linear_ = velocity.linear;
  angular_ = velocity.angular;
  commanded_ = true;
}

// A rigid motion is added to all links: joints hold as before.
void SpatialDrive::update(World& world, double, double) {
  if (!commanded_) return;
  const Pose pose = world.pose(object_);
  const Twist now = world.velocity(object_);
  const Vector3 linear = pose.orientation * linear_ - now.linear;
  const Vector3 angular = pose.orientation * angular_ - now.angular;
  std::vector<Twist> wanted;
  wanted.reserve(links_.size());
  for (const ObjectId link : links_) {
    const Twist twist = world.velocity(link);
    const Vector3 arm = world.pose(link).position - pose.position;
    wanted.push_back({twist.linear + linear + angular.cross(arm), twist.angular + angular});
  }
  for (std::size_t i = 0; i < links_.size(); ++i) world.set_velocity(links_[i], wanted[i]);
}

void SpatialDrive::reset(World&) {
  linear_ = angular_ = Vector3();
  commanded_ = false;
}

void SpatialDrive::transfer(StateArchive& archive) { archive(linear_, angular_, commanded_); }

}  // namespace bubblesim
