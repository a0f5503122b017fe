// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/velocity_decay.hpp"

#include "devices/link_bodies.hpp"

namespace bubblesim {
namespace {

/// The angular momentum of a link about its centre of mass, world axes.
Vector3 spin_of(const LinkDescription& link, const LinkMotion& motion) {
  const Quaternion& turn = motion.pose.orientation;
  return turn * (link.inertia() * (turn.conjugate() * motion.twist.angular));
}

}  // namespace

void VelocityDecay::update(World& world, double, double duration) {
  if (revision_ != world.revision()) {
    slowed_ = moving_links(world,
                           [](const LinkDescription& link) { return link.linear_decay > 0 || link.angular_decay > 0; });
    revision_ = world.revision();
  }
  for (const ObjectId id : slowed_) {
    const LinkDescription& link = link_description(world, id);
    const LinkMotion motion = motion_of(world, id);
    world.wrenches().apply(id, {-motion.twist.linear * (link.mass * mean_decay(link.linear_decay, duration)),
                                -spin_of(link, motion) * mean_decay(link.angular_decay, duration)});
  }
}

}  // namespace bubblesim
