// SPDX-License-Identifier: BSD-3-Clause
// The message of a contact sensor.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/sensor_kinds.hpp"
#include "bubblesim/world.hpp"
#include "parts.hpp"

namespace bubblesim::reading_messages {

/// A contact of a link with another; names are MODEL::LINK::COLLISION.
struct TouchReading {
  std::string own;
  std::string other;
  std::vector<Vector3> forces;    ///< N on the link, for each point
  std::vector<double> positions;  ///< m: x, y, z of each point
  std::vector<double> normals;    ///< x, y, z for each point
  std::vector<double> depths;     ///< m
};

/// The contacts of a link, in the frame of `reference` (kNoObject: of the world).
std::vector<TouchReading> read_touches(const World& world, ObjectId link, const ContactReading& reading,
                                       ObjectId reference);

/// gazebo_msgs/ContactsState.
void contacts_state(Fields& fields, const Header& header, const std::vector<TouchReading>& touches);

}  // namespace bubblesim::reading_messages
