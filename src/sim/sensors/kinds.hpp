// SPDX-License-Identifier: BSD-3-Clause
// The maker of each sensor kind, in the file of that kind. A new kind adds its line here.
#pragma once

#include <memory>

#include "bubblesim/sensor.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

/// What the maker of a sensor may need besides the description.
struct SensorSite {
  ObjectId id;
  const World& world;
  const Environment& environment;
};

std::unique_ptr<Sensor> make_kind(const SonarDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const LidarDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const CameraDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const ImuDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const NavSatDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const AltimeterDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const MagnetometerDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const ContactDescription&, const SensorSite&);
std::unique_ptr<Sensor> make_kind(const ForceTorqueDescription&, const SensorSite&);

}  // namespace bubblesim
