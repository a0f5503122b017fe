// SPDX-License-Identifier: BSD-3-Clause
#include "devices/link_bodies.hpp"

#include <string>

#include "bubblesim/error.hpp"

namespace bubblesim {

const LinkDescription& link_description(const World& world, ObjectId link) {
  const Object& object = world.tree().at(link);
  if (object.kind != ObjectKind::kLink) {
    throw WrongObject(world.tree().short_path(link) + " is a " + std::string(kind_name(object.kind)) + ", not a link");
  }
  return world.models().description(link).links[object.index];
}

void check_pushable(const World& world, ObjectId link) {
  link_description(world, link);
  if (world.models().description(link).is_static) {
    throw WrongObject(world.tree().short_path(link) + " is static: it cannot be moved");
  }
}

std::vector<ObjectId> moving_links(const World& world, const std::function<bool(const LinkDescription&)>& matches) {
  std::vector<ObjectId> found;
  for (const ObjectId model : world.tree().models()) {
    if (world.models().description(model).is_static) continue;
    for (const ObjectId link : world.tree().parts(model, ObjectKind::kLink)) {
      if (matches(link_description(world, link))) found.push_back(link);
    }
  }
  return found;
}

LinkMotion motion_of(const World& world, ObjectId link) {
  LinkMotion motion{world.pose(link), {}, world.velocity(link)};
  const Vector3 offset = motion.pose.orientation * link_description(world, link).centre_of_mass;
  motion.centre = motion.pose.position + offset;
  motion.twist.linear += motion.twist.angular.cross(offset);
  return motion;
}

}  // namespace bubblesim
