// SPDX-License-Identifier: BSD-3-Clause
// Masses and motions of links, for devices that exert forces on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bubblesim/world.hpp"

namespace bubblesim {

/// Throws NoSuchObject, and WrongObject when the object is not a link.
const LinkDescription& link_description(const World& world, ObjectId link);

/// Throws what link_description() throws, and WrongObject when the link is static.
void check_pushable(const World& world, ObjectId link);

/// The links of all models that are not static and match.
std::vector<ObjectId> moving_links(const World& world, const std::function<bool(const LinkDescription&)>& matches);

/// The pose of a link with the velocity of its centre of mass.
struct LinkMotion {
  Pose pose;
  Vector3 centre;  ///< m, centre of mass in the world
  Twist twist;     ///< linear: of the centre of mass
};
LinkMotion motion_of(const World& world, ObjectId link);

/// The mean of exp(-rate t) over a time, times the rate, in 1/s: a force of -m v times this slows a free body exactly
/// as the exponential does.
inline double mean_decay(double rate, double duration) { return -std::expm1(-rate * duration) / duration; }

}  // namespace bubblesim
