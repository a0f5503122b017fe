// SPDX-License-Identifier: BSD-3-Clause
// The registry of sensor kinds.
#include "sensors/kinds.hpp"

namespace bubblesim {
namespace {

struct SensorMaker {
  ObjectId id;
  const World& world;
  const Environment& environment;

  std::unique_ptr<Sensor> operator()(const SonarDescription& sonar) const { return make_sonar(sonar, id, world); }
  std::unique_ptr<Sensor> operator()(const ImuDescription& imu) const { return make_imu(imu, id); }
  std::unique_ptr<Sensor> operator()(const LidarDescription& lidar) const { return make_lidar(lidar, id); }
  std::unique_ptr<Sensor> operator()(const NavSatDescription& navsat) const {
    return make_navsat(navsat, environment.origin, id);
  }
  std::unique_ptr<Sensor> operator()(const AltimeterDescription& altimeter) const {
    return make_altimeter(altimeter, id, world);
  }
  std::unique_ptr<Sensor> operator()(const MagnetometerDescription& magnetometer) const {
    return make_magnetometer(magnetometer, environment.magnetic_field, id);
  }
  std::unique_ptr<Sensor> operator()(const ContactDescription& contact) const {
    return make_contact(contact, id, world);
  }
  std::unique_ptr<Sensor> operator()(const ForceTorqueDescription& force_torque) const {
    return make_force_torque(force_torque, id, world);
  }
  std::unique_ptr<Sensor> operator()(const CameraDescription& camera) const {
    return make_camera(camera, environment, id);
  }
};

}  // namespace

std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, const Environment& environment, ObjectId id,
                                    const World& world) {
  return std::visit(SensorMaker{id, world, environment}, description.kind);
}

}  // namespace bubblesim
