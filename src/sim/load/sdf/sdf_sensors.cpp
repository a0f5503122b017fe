// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_sensors.hpp"

#include <cmath>
#include <map>
#include <sdf/Altimeter.hh>
#include <sdf/Camera.hh>
#include <sdf/ForceTorque.hh>
#include <sdf/Imu.hh>
#include <sdf/Lidar.hh>
#include <sdf/Magnetometer.hh>
#include <sdf/NavSat.hh>
#include <sdf/Noise.hh>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/sdf_names_and_axes.hpp"
#include "load/sdf/sdf_plugins.hpp"
#include "load/sdf/sdf_source.hpp"
#include "load/sdf_extensions.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

const std::vector<std::string> kSimulated = {"sonar",        "ray",          "lidar",
                                             "gpu_ray",      "gpu_lidar",    "camera",
                                             "depth_camera", "rgbd_camera",  "segmentation_camera",
                                             "imu",          "navsat",       "gps",
                                             "altimeter",    "magnetometer", "contact",
                                             "force_torque"};

std::string list_of_simulated() {
  std::string list;
  for (const std::string& type : kSimulated) list += (list.empty() ? "" : ", ") + type;
  return list;
}

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

/// SDFormat has a number of samples and a resolution that multiplies it.
ScanAngles read_angles(unsigned int samples, double resolution, double min, double max) {
  const double rays = std::round(samples * resolution);
  return {static_cast<int>(std::min(rays, 1e9)), min, max};
}

/// Like Gazebo: rings in any order; a single ring, or none, is horizontal.
void straighten(ScanAngles& vertical, const Source& source, const std::string& path, LoadContext& reading) {
  const std::string angles = text(vertical.min) + " to " + text(vertical.max) + " rad";
  if (vertical.samples < 1 || (vertical.samples == 1 && vertical.min != vertical.max)) {
    reading.warn(
        source, path,
        std::to_string(vertical.samples) + " vertical samples from " + angles + ": using a single ring at 0 rad");
    vertical = {1, 0, 0};
  } else if (vertical.min > vertical.max) {
    reading.warn(source, path, "the vertical angles are " + angles + ": using them from low to high");
    std::swap(vertical.min, vertical.max);
  }
}

LidarDescription read_lidar(const sdf::Lidar& lidar, const std::string& path, LoadContext& reading) {
  LidarDescription description;
  description.horizontal =
      read_angles(lidar.HorizontalScanSamples(), lidar.HorizontalScanResolution(),
                  lidar.HorizontalScanMinAngle().Radian(), lidar.HorizontalScanMaxAngle().Radian());
  description.vertical = read_angles(lidar.VerticalScanSamples(), lidar.VerticalScanResolution(),
                                     lidar.VerticalScanMinAngle().Radian(), lidar.VerticalScanMaxAngle().Radian());
  straighten(description.vertical, source_of(lidar.Element()), path, reading);
  description.min_range = lidar.RangeMin();
  description.max_range = lidar.RangeMax();
  // Some models have a resolution that would leave no range.
  description.resolution = lidar.RangeResolution() < lidar.RangeMax() ? lidar.RangeResolution() : 0;
  description.noise = read_noise(lidar.LidarNoise());
  description.signal = own_text(lidar.Element(), "bubblesim:signal").value_or("");
  return description;
}

ImuDescription read_imu(const sdf::Imu& imu, LoadContext& reading) {
  ImuDescription description;
  description.bandwidth = own_number(imu.Element(), "bubblesim:bandwidth", reading.problems()).value_or(0);
  description.angular_velocity_noise = {read_noise(imu.AngularVelocityXNoise()),
                                        read_noise(imu.AngularVelocityYNoise()),
                                        read_noise(imu.AngularVelocityZNoise())};
  description.linear_acceleration_noise = {read_noise(imu.LinearAccelerationXNoise()),
                                           read_noise(imu.LinearAccelerationYNoise()),
                                           read_noise(imu.LinearAccelerationZNoise())};
  return description;
}

NavSatDescription read_navsat(const sdf::NavSat& navsat) {
  NavSatDescription description;
  description.horizontal_position_noise = read_noise(navsat.HorizontalPositionNoise());
  description.vertical_position_noise = read_noise(navsat.VerticalPositionNoise());
  description.horizontal_velocity_noise = read_noise(navsat.HorizontalVelocityNoise());
  description.vertical_velocity_noise = read_noise(navsat.VerticalVelocityNoise());
  return description;
}

AltimeterDescription read_altimeter(const sdf::Altimeter& altimeter) {
  return {read_noise(altimeter.VerticalPositionNoise()), read_noise(altimeter.VerticalVelocityNoise())};
}

MagnetometerDescription read_magnetometer(const sdf::Magnetometer& magnetometer) {
  return {{read_noise(magnetometer.XNoise()), read_noise(magnetometer.YNoise()), read_noise(magnetometer.ZNoise())}};
}

ForceTorqueDescription read_force_torque(const sdf::ForceTorque& sensor, LoadContext& reading) {
  using Frame = ForceTorqueDescription::Frame;
  ForceTorqueDescription description;
  description.bandwidth = own_number(sensor.Element(), "bubblesim:bandwidth", reading.problems()).value_or(0);
  if (sensor.Frame() == sdf::ForceTorqueFrame::PARENT) description.frame = Frame::kParent;
  if (sensor.Frame() == sdf::ForceTorqueFrame::SENSOR) description.frame = Frame::kSensor;
  description.of_child = sensor.MeasureDirection() != sdf::ForceTorqueMeasureDirection::PARENT_TO_CHILD;
  description.force_noise = {read_noise(sensor.ForceXNoise()), read_noise(sensor.ForceYNoise()),
                             read_noise(sensor.ForceZNoise())};
  description.torque_noise = {read_noise(sensor.TorqueXNoise()), read_noise(sensor.TorqueYNoise()),
                              read_noise(sensor.TorqueZNoise())};
  return description;
}

/// SDFormat has no class for contact sensors.
ContactDescription read_contact(const sdf::ElementPtr& sensor) {
  ContactDescription description;
  if (!sensor->HasElement("contact")) return description;
  for (auto each = sensor->GetElement("contact")->FindElement("collision"); each;
       each = each->GetNextElement("collision")) {
    const auto name = each->Get<std::string>();
    const std::size_t scope = name.rfind("::");  // some files have model::link::collision
    description.collisions.push_back(scope == std::string::npos ? name : name.substr(scope + 2));
  }
  return description;
}

/// Gazebo accepts half a turn, for which the image plane would be infinite.
void widen_at_most(double& field_of_view, const Source& source, const std::string& path, LoadContext& reading) {
  constexpr double kWide = 3.1;
  constexpr double kWidest = 3.13;
  if (!(field_of_view > kWide && field_of_view <= M_PI + 1e-3)) return;
  const std::string taken = field_of_view > kWidest ? ", using " + text(kWidest) : "";
  reading.warn(source, path,
               "the horizontal field of view is " + text(field_of_view) + " rad" + taken +
                   ": objects ahead are tiny in such an image");
  field_of_view = std::min(field_of_view, kWidest);
}

CameraDescription read_camera(const sdf::Camera& camera, bool depth_only, const std::string& path, const Report& report,
                              LoadContext& reading) {
  CameraDescription description;
  description.width = static_cast<int>(camera.ImageWidth());
  description.height = static_cast<int>(camera.ImageHeight());
  description.horizontal_fov = camera.HorizontalFov().Radian();
  widen_at_most(description.horizontal_fov, source_of(camera.Element(), "horizontal_fov"), path, reading);
  description.near = depth_only && camera.HasDepthNearClip() ? camera.DepthNearClip() : camera.NearClip();
  description.far = depth_only && camera.HasDepthFarClip() ? camera.DepthFarClip() : camera.FarClip();
  // Plugins of depth cameras publish colour images, too.
  const sdf::ElementPtr sensor = camera.Element()->GetParent();
  description.color = !depth_only || (sensor != nullptr && sensor->HasElement("plugin"));
  description.noise = read_noise(camera.ImageNoise());
  // SDFormat stores a plain true as 1.
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

void tell_left_out(const Source& source, const std::string& path, const std::string& type, LoadContext& reading) {
  reading.warn(source, path,
               "sensors of type '" + type +
                   "' are not simulated: this sensor is ignored; simulated types: " + list_of_simulated());
}

/// Reads kind and parameters of a sensor into `description`, whose pose is known already. Returns false when the kind
/// is unknown or not simulated; the reason is reported.
bool read_kind(const sdf::Sensor& sensor, const std::string& path, SensorDescription& description, const Report& report,
               LoadContext& reading) {
  switch (sensor.Type()) {
    case sdf::SensorType::SONAR:
      return read_sonar(sensor, description, report);
    case sdf::SensorType::IMU:
      description.kind = sensor.ImuSensor() != nullptr ? read_imu(*sensor.ImuSensor(), reading) : ImuDescription{};
      return true;
    case sdf::SensorType::NAVSAT:
    case sdf::SensorType::GPS:
      description.kind = sensor.NavSatSensor() != nullptr ? read_navsat(*sensor.NavSatSensor()) : NavSatDescription{};
      return true;
    case sdf::SensorType::ALTIMETER:
      description.kind =
          sensor.AltimeterSensor() != nullptr ? read_altimeter(*sensor.AltimeterSensor()) : AltimeterDescription{};
      return true;
    case sdf::SensorType::MAGNETOMETER:
      description.kind = sensor.MagnetometerSensor() != nullptr ? read_magnetometer(*sensor.MagnetometerSensor())
                                                                : MagnetometerDescription{};
      return true;
    case sdf::SensorType::CONTACT:
      description.kind = read_contact(sensor.Element());
      return true;
    case sdf::SensorType::FORCE_TORQUE:
      description.kind = sensor.ForceTorqueSensor() != nullptr ? read_force_torque(*sensor.ForceTorqueSensor(), reading)
                                                               : ForceTorqueDescription{};
      return true;
    case sdf::SensorType::LIDAR:
    case sdf::SensorType::GPU_LIDAR:
      if (const sdf::Lidar* lidar = sensor.LidarSensor()) {
        description.kind = read_lidar(*lidar, path, reading);
        return true;
      }
      report(description.source, "a lidar needs a <lidar> element with <scan> and <range>");
      return false;
    case sdf::SensorType::CAMERA:
    case sdf::SensorType::DEPTH_CAMERA:
    case sdf::SensorType::RGBD_CAMERA:
    case sdf::SensorType::SEGMENTATION_CAMERA:
      if (const sdf::Camera* camera = sensor.CameraSensor()) {
        description.kind = read_camera(*camera, sensor.Type() == sdf::SensorType::DEPTH_CAMERA, path, report, reading);
        description.pose = description.pose * camera->RawPose();
        return true;
      }
      report(description.source, "a camera needs a <camera> element with <horizontal_fov>, <image> and <clip>");
      return false;
    case sdf::SensorType::NONE: {
      const auto type = sensor.Element()->Get<std::string>("type");
      if (type == "air_speed" || type == "custom" || type == "dvl") {  // of later SDFormat versions
        tell_left_out(description.source, path, type, reading);
        return false;
      }
      report(description.source, "SDFormat has no sensor type '" + type + "'" + did_you_mean(type, kSimulated));
      return false;
    }
    default:
      tell_left_out(description.source, path, sensor.TypeStr(), reading);
      return false;
  }
}

/// The text of the first existing element, without surrounding spaces.
std::string first_text(const sdf::ElementPtr& parent, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (parent == nullptr) break;
    if (const auto text = own_text(parent, name)) return *text;
  }
  return "";
}

/// SDFormat has no functions for most of these elements; later versions of the format have more.
GzTopic read_gz_topic(const sdf::ElementPtr& sensor) {
  const sdf::ElementPtr contact = sensor->FindElement("contact");
  const sdf::ElementPtr camera = sensor->FindElement("camera");
  GzTopic gz;
  for (const sdf::ElementPtr& element : {contact, sensor}) {
    gz.topic = first_text(element, {"topic"});
    if (gz.topic.rfind("__default", 0) == 0) gz.topic.clear();  // SDFormat's defaults
    if (!gz.topic.empty()) break;
  }
  gz.info_topic = first_text(camera, {"camera_info_topic"});
  gz.frame = first_text(camera, {"optical_frame_id"});
  if (gz.frame.empty()) gz.frame = first_text(sensor, {"gz_frame_id", "ignition_frame_id", "frame_id"});
  return gz;
}

SensorDescription read_any(const sdf::Sensor& sensor, const Pose& pose, const std::string& path, LoadContext& reading) {
  SensorDescription description;
  description.name = sensor.Name();
  description.alias = read_alias(sensor.Element(), path, reading);
  description.type = sensor.TypeStr();
  description.gz = read_gz_topic(sensor.Element());
  description.source = source_of(sensor.Element());
  description.pose = pose;
  description.update_rate = sensor.UpdateRate();
  description.plugins = read_plugins(sensor.Element());
  description.topic = own_text(sensor.Element(), "bubblesim:topic").value_or("");
  description.frame = own_text(sensor.Element(), "bubblesim:frame").value_or("");
  return description;
}

}  // namespace

std::optional<SensorDescription> read_sensor(const sdf::Sensor& sensor, const std::string& carrier_path,
                                             const Pose& pose, LoadContext& reading) {
  const std::string path = carrier_path + "/" + sensor.Name();
  SensorDescription description = read_any(sensor, pose, path, reading);
  const Report report_here = [&](const Source& source, std::string message) {
    reading.report(source, path, std::move(message));
  };
  if (!read_kind(sensor, path, description, report_here, reading)) return std::nullopt;
  return description;
}

std::vector<SensorDescription> read_multicamera(const sdf::Sensor& sensor, const std::string& carrier_path,
                                                const Pose& pose, LoadContext& reading) {
  const std::string path = carrier_path + "/" + sensor.Name();
  const Report report_here = [&](const Source& source, std::string message) {
    reading.report(source, path, std::move(message));
  };
  std::vector<SensorDescription> all;
  for (auto element = sensor.Element()->FindElement("camera"); element; element = element->GetNextElement("camera")) {
    sdf::Camera camera;
    reading.take(camera.Load(element), path);
    SensorDescription& description = all.emplace_back(read_any(sensor, pose * camera.RawPose(), path, reading));
    description.name += "_" + camera.Name();
    for (std::string* topic : {&description.topic, &description.gz.topic}) {
      if (!topic->empty()) *topic += "/" + camera.Name();
    }
    description.kind = read_camera(camera, false, path, report_here, reading);
  }
  if (all.empty()) report_here(source_of(sensor.Element()), "a multicamera needs a <camera> for each of its cameras");
  return all;
}

}  // namespace bubblesim
