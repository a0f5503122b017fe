// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_check.hpp"

#include <cmath>

#include "checks.hpp"
#include "describe.hpp"

namespace bubblesim {
namespace {

constexpr int kMaxSamples = 100000;  // of a lidar, in a ring or of rings
constexpr int kMaxPixels = 16384;    // of a picture, across or down

class KindChecker {
 public:
  explicit KindChecker(const Require& require) : require_(require) {}

  void operator()(const LidarDescription& lidar) {
    check_scan("horizontal", lidar.horizontal, 2 * M_PI);
    check_scan("vertical", lidar.vertical, M_PI / 2);
    check_ranges(lidar.min_range, lidar.max_range);
    require_(lidar.resolution >= 0 && lidar.resolution <= lidar.max_range, "the range's resolution",
             text(lidar.resolution) + " m", "0 (not rounded) to the maximal range");
    check_noise(lidar.noise);
  }

  void operator()(const CameraDescription& camera) {
    require_(camera.width >= 1 && camera.width <= kMaxPixels && camera.height >= 1 && camera.height <= kMaxPixels,
             "the picture's size", std::to_string(camera.width) + " x " + std::to_string(camera.height),
             "1 to " + std::to_string(kMaxPixels) + " pixels each way");
    require_(camera.horizontal_fov > 0 && camera.horizontal_fov < 3.1, "the horizontal field of view",
             text(camera.horizontal_fov) + " rad", "above 0 and below 3.1: a pinhole camera cannot see beside itself");
    require_(camera.far > 0 && camera.far <= kMaxSize, "the far plane", text(camera.far) + " m", "above 0");
    require_(camera.near > 0 && camera.near < camera.far, "the near plane", text(camera.near) + " m",
             "above 0 and before the far plane");
    check_noise(camera.noise);
  }

  void operator()(const ImuDescription& imu) {
    for (const NoiseDescription& noise : imu.angular_velocity_noise) check_noise(noise);
    for (const NoiseDescription& noise : imu.linear_acceleration_noise) check_noise(noise);
  }

  void operator()(const SonarDescription& sonar) {
    check_ranges(sonar.min_range, sonar.max_range);
    require_(sonar.half_angle >= 0 && sonar.half_angle < M_PI / 2, "the cone's half angle",
             text(sonar.half_angle) + " rad", "from 0 to below pi/2");
  }

  void operator()(const NavSatDescription& navsat) {
    check_noise(navsat.horizontal_position_noise);
    check_noise(navsat.vertical_position_noise);
    check_noise(navsat.horizontal_velocity_noise);
    check_noise(navsat.vertical_velocity_noise);
  }

  void operator()(const ContactDescription&) {}

  void operator()(const ForceTorqueDescription& force_torque) {
    for (const NoiseDescription& noise : force_torque.force_noise) check_noise(noise);
    for (const NoiseDescription& noise : force_torque.torque_noise) check_noise(noise);
  }

 private:
  void check_ranges(double min_range, double max_range) {
    require_(max_range > 0 && max_range <= kMaxSize, "the maximal range", text(max_range) + " m",
             "above 0 and at most 1e5 m");
    require_(min_range >= 0 && min_range < max_range, "the minimal range", text(min_range) + " m",
             "0 or more and below the maximal range");
  }

  void check_noise(const NoiseDescription& noise) {
    require_(within(noise.mean, kMaxSize), "the noise's mean", text(noise.mean), "finite");
    require_(within(noise.bias_mean, kMaxSize), "the bias's mean", text(noise.bias_mean), "finite");
    for (const double deviation : {noise.stddev, noise.bias_stddev, noise.precision}) {
      require_(deviation >= 0 && deviation <= kMaxSize, "the noise's standard deviation or precision", text(deviation),
               "0 or more");
    }
  }

  void check_scan(const char* what, const ScanAngles& scan, double reach) {
    const std::string name = what;
    require_(scan.samples >= 1 && scan.samples <= kMaxSamples, "the number of " + name + " samples",
             std::to_string(scan.samples), "1 to " + std::to_string(kMaxSamples));
    require_(within(scan.min, reach) && within(scan.max, reach) && scan.min <= scan.max,
             "the range of " + name + " angles", text(scan.min) + " to " + text(scan.max) + " rad",
             "from low to high, at most +-" + text(reach));
  }

  const Require& require_;
};

}  // namespace

void check_sensor(const SensorDescription& sensor, const Require& require) {
  require(sensor.update_rate >= 0 && within(sensor.update_rate, 1e5), "the update rate",
          text(sensor.update_rate) + " Hz", "0 (every pass) to 1e5 Hz");
  std::visit(KindChecker(require), sensor.kind);
}

}  // namespace bubblesim
