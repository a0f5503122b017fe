// SPDX-License-Identifier: BSD-3-Clause
// Factory functions of the sensor kinds. A new kind adds its file, its description in scene.hpp, its measurement in
// sensor.hpp and its line here and in registry.cpp.
#pragma once

#include "bubblesim/sensor.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

std::unique_ptr<Sensor> make_sonar(const SonarDescription&, ObjectId, const World&);
std::unique_ptr<Sensor> make_imu(const ImuDescription&, ObjectId);
std::unique_ptr<Sensor> make_lidar(const LidarDescription&, ObjectId);
std::unique_ptr<Sensor> make_navsat(const NavSatDescription&, const GeographicOrigin&, ObjectId);
std::unique_ptr<Sensor> make_altimeter(const AltimeterDescription&, ObjectId, const World&);
std::unique_ptr<Sensor> make_magnetometer(const MagnetometerDescription&, const Vector3& field, ObjectId);
std::unique_ptr<Sensor> make_contact(const ContactDescription&, ObjectId, const World&);
std::unique_ptr<Sensor> make_force_torque(const ForceTorqueDescription&, ObjectId, const World&);
std::unique_ptr<Sensor> make_camera(const CameraDescription&, const Environment&, ObjectId);

}  // namespace bubblesim
