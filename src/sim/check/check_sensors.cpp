// SPDX-License-Identifier: BSD-3-Clause
// Checks whether the sensors of links and joints can be simulated.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "check/checker.hpp"
#include "check/checks.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

constexpr int kMaxSamples = 100000;  // of a lidar, per ring and number of rings
constexpr int kMaxPixels = 16384;    // of an image, width and height

void check_ranges(Checker& checker, double min_range, double max_range) {
  checker.require(max_range > 0 && max_range <= kMaxSize, "the maximum range", text(max_range) + " m",
                  "above 0 and at most 1e5 m");
  checker.require(min_range >= 0 && min_range < max_range, "the minimum range", text(min_range) + " m",
                  "0 or more and below the maximum range");
}

void check_noise(Checker& checker, const NoiseDescription& noise) {
  checker.require(within(noise.mean, kMaxSize), "the noise's mean", text(noise.mean), "finite");
  checker.require(within(noise.bias_mean, kMaxSize), "the bias's mean", text(noise.bias_mean), "finite");
  for (const double deviation : {noise.stddev, noise.bias_stddev, noise.precision}) {
    checker.require(deviation >= 0 && deviation <= kMaxSize, "the noise's standard deviation or precision",
                    text(deviation), "0 or more");
  }
}

void check_scan(Checker& checker, const char* what, const ScanAngles& scan, double reach) {
  const std::string name = what;
  checker.require(scan.samples >= 1 && scan.samples <= kMaxSamples, "the number of " + name + " samples",
                  std::to_string(scan.samples), "1 to " + std::to_string(kMaxSamples));
  constexpr double kRounded = 1e-3;  // rad: files write 6.28319 for a turn and 1.5708 for a quarter
  checker.require(within(scan.min, reach + kRounded) && within(scan.max, reach + kRounded) && scan.min <= scan.max,
                  "the range of " + name + " angles", text(scan.min) + " to " + text(scan.max) + " rad",
                  "from low to high, at most +-" + text(reach));
}

void check_sensor(Checker& checker, const LidarDescription& lidar) {
  check_scan(checker, "horizontal", lidar.horizontal, 2 * M_PI);
  check_scan(checker, "vertical", lidar.vertical, M_PI / 2);
  check_ranges(checker, lidar.min_range, lidar.max_range);
  checker.require(lidar.resolution >= 0 && lidar.resolution <= lidar.max_range, "the range resolution",
                  text(lidar.resolution) + " m", "0 (not rounded) to the maximum range");
  check_noise(checker, lidar.noise);
}

void check_sensor(Checker& checker, const CameraDescription& camera) {
  checker.require(camera.width >= 1 && camera.width <= kMaxPixels && camera.height >= 1 && camera.height <= kMaxPixels,
                  "the image size", std::to_string(camera.width) + " x " + std::to_string(camera.height),
                  "1 to " + std::to_string(kMaxPixels) + " pixels in width and height");
  checker.require(camera.horizontal_fov > 0 && camera.horizontal_fov < 3.14, "the horizontal field of view",
                  text(camera.horizontal_fov) + " rad", "above 0 and below 3.14 (pinhole camera)");
  checker.require(camera.far > 0 && camera.far <= kMaxSize, "the distance of the far plane", text(camera.far) + " m",
                  "above 0");
  checker.require(camera.near > 0 && camera.near < camera.far, "the distance of the near plane",
                  text(camera.near) + " m", "above 0 and less than that of the far plane");
  check_noise(checker, camera.noise);
}

void check_bandwidth(Checker& checker, double bandwidth) {
  checker.require(bandwidth >= 0 && within(bandwidth, 1e6), "the bandwidth", text(bandwidth) + " Hz",
                  "0 (no filter) to 1e6 Hz");
}

void check_sensor(Checker& checker, const ImuDescription& imu) {
  check_bandwidth(checker, imu.bandwidth);
  for (const NoiseDescription& noise : imu.angular_velocity_noise) check_noise(checker, noise);
  for (const NoiseDescription& noise : imu.linear_acceleration_noise) check_noise(checker, noise);
}

void check_sensor(Checker& checker, const SonarDescription& sonar) {
  check_ranges(checker, sonar.min_range, sonar.max_range);
  checker.require(sonar.half_angle >= 0 && sonar.half_angle < M_PI / 2, "the cone's half angle",
                  text(sonar.half_angle) + " rad", "from 0 to below pi/2");
}

void check_sensor(Checker& checker, const NavSatDescription& navsat) {
  check_noise(checker, navsat.horizontal_position_noise);
  check_noise(checker, navsat.vertical_position_noise);
  check_noise(checker, navsat.horizontal_velocity_noise);
  check_noise(checker, navsat.vertical_velocity_noise);
}

void check_sensor(Checker& checker, const AltimeterDescription& altimeter) {
  check_noise(checker, altimeter.position_noise);
  check_noise(checker, altimeter.velocity_noise);
}

void check_sensor(Checker& checker, const MagnetometerDescription& magnetometer) {
  for (const NoiseDescription& noise : magnetometer.field_noise) check_noise(checker, noise);
}

void check_sensor(Checker&, const ContactDescription&) {}

void check_sensor(Checker& checker, const ForceTorqueDescription& force_torque) {
  check_bandwidth(checker, force_torque.bandwidth);
  for (const NoiseDescription& noise : force_torque.force_noise) check_noise(checker, noise);
  for (const NoiseDescription& noise : force_torque.torque_noise) check_noise(checker, noise);
}

void check_any_sensor(Checker& checker, const SensorDescription& sensor, const std::string& path) {
  checker.at(sensor.source, path + "/" + sensor.name);
  checker.check_pose(sensor.pose);
  checker.require(sensor.update_rate >= 0 && within(sensor.update_rate, 1e5), "the update rate",
                  text(sensor.update_rate) + " Hz", "0 (every step) to 1e5 Hz");
  std::visit([&checker](const auto& kind) { check_sensor(checker, kind); }, sensor.kind);
}

void check_collisions(Checker& checker, const LinkDescription& link, const ContactDescription& contact) {
  std::vector<std::string> names;
  for (const CollisionDescription& collision : link.collisions) names.push_back(collision.name);
  for (const std::string& name : contact.collisions) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    checker.report("'" + name + "' is not a collision of this link" + did_you_mean(name, names));
  }
}

}  // namespace

void check_sensors(Checker& checker, const LinkDescription& link, const std::string& path) {
  for (const SensorDescription& sensor : link.sensors) {
    check_any_sensor(checker, sensor, path);
    if (const auto* contact = std::get_if<ContactDescription>(&sensor.kind)) check_collisions(checker, link, *contact);
    if (!std::holds_alternative<ForceTorqueDescription>(sensor.kind)) continue;
    checker.report("a force_torque sensor measures the forces of a joint: put it into a <joint>");
  }
}

void check_sensors(Checker& checker, const JointDescription& joint, const std::string& path) {
  for (const SensorDescription& sensor : joint.sensors) {
    check_any_sensor(checker, sensor, path);
    if (std::holds_alternative<ForceTorqueDescription>(sensor.kind)) continue;
    checker.report("a joint can have sensors of type force_torque only: put this sensor into a <link>");
  }
}

}  // namespace bubblesim
