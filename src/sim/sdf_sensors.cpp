// SPDX-License-Identifier: BSD-3-Clause
#include "sdf_sensors.hpp"

#include <cmath>
#include <map>
#include <sdf/Camera.hh>
#include <sdf/Imu.hh>
#include <sdf/Lidar.hh>
#include <sdf/Noise.hh>
#include <string>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "own_elements.hpp"

namespace bubblesim {
namespace {

const std::map<std::string, ProximityVolume>& volumes() {
  static const std::map<std::string, ProximityVolume> names = {
      {"ray", ProximityVolume::kRay},           {"cone", ProximityVolume::kCone},
      {"pyramid", ProximityVolume::kPyramid},   {"disc", ProximityVolume::kDisc},
      {"cylinder", ProximityVolume::kCylinder},
  };
  return names;
}

NoiseDescription read_noise(const sdf::Noise& noise) {
  NoiseDescription description;
  if (noise.Type() == sdf::NoiseType::NONE) return description;
  description.mean = noise.Mean();
  description.stddev = noise.StdDev();
  description.bias_mean = noise.BiasMean();
  description.bias_stddev = noise.BiasStdDev();
  if (noise.Type() == sdf::NoiseType::GAUSSIAN_QUANTIZED) description.precision = noise.Precision();
  return description;
}

/// SDFormat counts samples and multiplies them by a resolution.
ScanAngles read_angles(unsigned int samples, double resolution, double min, double max) {
  const double rays = std::round(samples * resolution);
  return {static_cast<int>(std::min(rays, 1e9)), min, max};
}

LidarDescription read_lidar(const sdf::Lidar& lidar) {
  LidarDescription description;
  description.horizontal =
      read_angles(lidar.HorizontalScanSamples(), lidar.HorizontalScanResolution(),
                  lidar.HorizontalScanMinAngle().Radian(), lidar.HorizontalScanMaxAngle().Radian());
  description.vertical = read_angles(lidar.VerticalScanSamples(), lidar.VerticalScanResolution(),
                                     lidar.VerticalScanMinAngle().Radian(), lidar.VerticalScanMaxAngle().Radian());
  description.min_range = lidar.RangeMin();
  description.max_range = lidar.RangeMax();
  // Some models have one that would leave no range at all.
  description.resolution = lidar.RangeResolution() < lidar.RangeMax() ? lidar.RangeResolution() : 0;
  description.noise = read_noise(lidar.LidarNoise());
  return description;
}

ImuDescription read_imu(const sdf::Imu& imu) {
  ImuDescription description;
  description.angular_velocity_noise = {read_noise(imu.AngularVelocityXNoise()),
                                        read_noise(imu.AngularVelocityYNoise()),
                                        read_noise(imu.AngularVelocityZNoise())};
  description.linear_acceleration_noise = {read_noise(imu.LinearAccelerationXNoise()),
                                           read_noise(imu.LinearAccelerationYNoise()),
                                           read_noise(imu.LinearAccelerationZNoise())};
  return description;
}

CameraDescription read_camera(const sdf::Camera& camera, bool depth_only, const Report& report) {
  CameraDescription description;
  description.width = static_cast<int>(camera.ImageWidth());
  description.height = static_cast<int>(camera.ImageHeight());
  description.horizontal_fov = camera.HorizontalFov().Radian();
  description.near = depth_only && camera.HasDepthNearClip() ? camera.DepthNearClip() : camera.NearClip();
  description.far = depth_only && camera.HasDepthFarClip() ? camera.DepthFarClip() : camera.FarClip();
  // Plugins of depth cameras publish pictures, too.
  const sdf::ElementPtr sensor = camera.Element()->GetParent();
  description.color = !depth_only || (sensor != nullptr && sensor->HasElement("plugin"));
  description.noise = read_noise(camera.ImageNoise());
  // SDFormat keeps a plain true as 1.
  const std::string antialias = own_text(camera.Element(), "bubblesim:antialias").value_or("false");
  description.antialias = antialias == "true" || antialias == "1";
  if (!description.antialias && antialias != "false" && antialias != "0") {
    report(source_of(camera.Element(), "bubblesim:antialias"),
           "<bubblesim:antialias> is '" + antialias + "', it must be true or false");
  }
  return description;
}

bool read_sonar(const sdf::Sensor& sensor, SensorDescription& description, const Report& report) {
  if (!sensor.Element()->HasElement("sonar")) {
    report(description.source, "a sonar needs a <sonar> element with <min>, <max> and <radius>");
    return false;
  }
  const sdf::ElementPtr element = sensor.Element()->GetElement("sonar");
  SonarDescription sonar;
  sonar.min_range = element->Get<double>("min", sonar.min_range).first;
  sonar.max_range = element->Get<double>("max", sonar.max_range).first;
  sonar.half_angle = std::atan2(element->Get<double>("radius", 0.0).first, sonar.max_range);  // radius at max
  if (const auto name = own_text(element, "bubblesim:volume")) {
    const auto volume = volumes().find(*name);
    if (volume == volumes().end()) {
      std::vector<std::string> known;
      for (const auto& [known_name, unused] : volumes()) known.push_back(known_name);
      report(source_of(element, "bubblesim:volume"), "<bubblesim:volume> is '" + *name +
                                                         "', it must be ray, cone, pyramid, disc or cylinder" +
                                                         did_you_mean(*name, known));
      return false;
    }
    sonar.volume = volume->second;
  }
  description.kind = sonar;
  return true;
}

}  // namespace

bool read_sensor_kind(const sdf::Sensor& sensor, SensorDescription& description, const Report& report) {
  switch (sensor.Type()) {
    case sdf::SensorType::SONAR:
      return read_sonar(sensor, description, report);
    case sdf::SensorType::IMU:
      description.kind = sensor.ImuSensor() != nullptr ? read_imu(*sensor.ImuSensor()) : ImuDescription{};
      return true;
    case sdf::SensorType::LIDAR:
    case sdf::SensorType::GPU_LIDAR:
      if (const sdf::Lidar* lidar = sensor.LidarSensor()) {
        description.kind = read_lidar(*lidar);
        return true;
      }
      report(description.source, "a lidar needs a <lidar> element with <scan> and <range>");
      return false;
    case sdf::SensorType::CAMERA:
    case sdf::SensorType::DEPTH_CAMERA:
    case sdf::SensorType::RGBD_CAMERA:
    case sdf::SensorType::SEGMENTATION_CAMERA:
      if (const sdf::Camera* camera = sensor.CameraSensor()) {
        description.kind = read_camera(*camera, sensor.Type() == sdf::SensorType::DEPTH_CAMERA, report);
        description.pose = description.pose * camera->RawPose();
        return true;
      }
      report(description.source, "a camera needs a <camera> element with <horizontal_fov>, <image> and <clip>");
      return false;
    default:
      report(description.source, "sensors of type '" + sensor.TypeStr() +
                                     "' are not supported; supported are sonar, ray or lidar, gpu_ray or gpu_lidar, "
                                     "camera, depth_camera, rgbd_camera, segmentation_camera, imu");
      return false;
  }
}

}  // namespace bubblesim
