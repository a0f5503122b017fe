// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "bubblesim/nearest_names.hpp"
#include "load/sdf/own_elements.hpp"
#include "load/sdf/sdf_names_and_axes.hpp"
#include "load/sdf/sdf_plugins.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

const std::vector<std::string> kSimulated = {"sonar",        "ray",          "lidar",
                                             "gpu_ray",      "gpu_lidar",    "camera",
                                             "depth_camera", "rgbd_camera",  "segmentation_camera",
                                             "imu",          "navsat",       "gps",
                                             "altimeter",    "magnetometer", "contact",
                                             "force_torque"};

bool is_left_out(const std::string& type) {
  static const std::set<std::string> types = {"air_pressure",
                                              "air_speed",
                                              "boundingbox_camera",
                                              "custom",
                                              "dvl",
                                              "logical_camera",
                                              "multicamera",
                                              "rfid",
                                              "rfidtag",
                                              "thermal_camera",
                                              "wide_angle_camera",
                                              "wireless_receiver",
                                              "wireless_transmitter"};
  return types.count(type) > 0;
}

/// The type by its newest name.
std::string type_of(const SdfElement& sensor) {
  static const std::map<std::string, std::string> newest = {
      {"boundingbox", "boundingbox_camera"},
      {"depth", "depth_camera"},
      {"gps", "navsat"},
      {"gpu_ray", "gpu_lidar"},
      {"ray", "lidar"},
      {"rgbd", "rgbd_camera"},
      {"segmentation", "segmentation_camera"},
      {"thermal", "thermal_camera"},
      {"wideanglecamera", "wide_angle_camera"},
  };
  const std::string type = sensor.attribute("type");
  const auto found = newest.find(type);
  return found != newest.end() ? found->second : type;
}

std::string list_of(const std::vector<std::string>& names, const std::string& last_separator) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 < names.size() ? ", " : last_separator;
    list += names[i];
  }
  return list;
}

/// Numbers of any size.
int to_int(double number) {
  constexpr double kMost = 1e9;
  return static_cast<int>(std::max(-kMost, std::min(number, kMost)));
}

NoiseDescription read_noise(const SdfElement& noise) {
  NoiseDescription description;
  const std::string type = noise.has_attribute("type") ? noise.attribute("type") : noise.text("type");
  if (!noise || (type != "gaussian" && type != "gaussian_quantized")) return description;
  description.mean = noise.number("mean");
  description.stddev = noise.number("stddev");
  description.bias_mean = noise.number("bias_mean");
  description.bias_stddev = noise.number("bias_stddev");
  if (type == "gaussian_quantized") description.precision = noise.number("precision");
  return description;
}

std::array<NoiseDescription, 3> read_axes_noise(const SdfElement& axes) {
  return {read_noise(axes.child("x").child("noise")), read_noise(axes.child("y").child("noise")),
          read_noise(axes.child("z").child("noise"))};
}

/// SDFormat has a number of samples and a resolution that multiplies it.
ScanAngles read_angles(const SdfElement& scan) {
  const double rays = std::round(scan.number("samples") * scan.number("resolution"));
  return {to_int(rays), scan.number("min_angle"), scan.number("max_angle")};
}

/// Some files have names with the scopes of the collision: model::link::collision.
std::string without_scope(const std::string& name) {
  const std::size_t scope = name.rfind("::");
  return scope == std::string::npos ? name : name.substr(scope + 2);
}

/// Reads the kind and parameters of the sensor at a path.
class KindReader {
 public:
  KindReader(const SdfElement& sensor, std::string type, std::string path, LoadContext& context)
      : sensor_(sensor), type_(std::move(type)), path_(std::move(path)), context_(context) {}

  /// Empty when the kind is unknown or not simulated; the reason is reported.
  std::optional<SensorKind> read() {
    using Read = std::optional<SensorKind> (KindReader::*)();
    static const std::map<std::string, Read> kinds = {
        {"sonar", &KindReader::read_sonar},
        {"imu", &KindReader::read_imu},
        {"navsat", &KindReader::read_navsat},
        {"altimeter", &KindReader::read_altimeter},
        {"magnetometer", &KindReader::read_magnetometer},
        {"contact", &KindReader::read_contact},
        {"force_torque", &KindReader::read_force_torque},
        {"lidar", &KindReader::read_lidar},
        {"gpu_lidar", &KindReader::read_lidar},
        {"camera", &KindReader::read_only_camera},
        {"depth_camera", &KindReader::read_only_camera},
        {"rgbd_camera", &KindReader::read_only_camera},
        {"segmentation_camera", &KindReader::read_only_camera},
    };
    if (const auto found = kinds.find(type_); found != kinds.end()) return (this->*found->second)();
    if (is_left_out(type_)) {
      context_.warn(sensor_.source(), path_,
                    "sensors of type '" + type_ +
                        "' are not simulated: this sensor is ignored; simulated types: " + list_of(kSimulated, ", "));
    } else {
      report(sensor_.source(), "SDFormat has no sensor type '" + type_ + "'" + did_you_mean(type_, kSimulated));
    }
    return std::nullopt;
  }

  CameraDescription read_camera(const SdfElement& camera) {
    const bool is_depth_only = type_ == "depth_camera";
    const SdfElement image = camera.child("image");
    const SdfElement clip = camera.child("clip");
    const SdfElement depth_clip = camera.child("depth_camera").child("clip");
    const auto distance = [&](const char* plane) {
      return (is_depth_only && depth_clip.has(plane) ? depth_clip : clip).number(plane);
    };
    CameraDescription description;
    description.width = to_int(image.number("width"));
    description.height = to_int(image.number("height"));
    description.horizontal_fov = read_field_of_view(camera);
    description.near = distance("near");
    description.far = distance("far");
    // Plugins of depth cameras publish colour images, too.
    description.color = !is_depth_only || sensor_.has("plugin");
    description.noise = read_noise(camera.child("noise"));
    const std::string antialias = own_text(camera, "bubblesim:antialias").value_or("false");
    description.antialias = is_true(antialias);
    if (!description.antialias && antialias != "false" && antialias != "0") {
      report(camera.source("bubblesim:antialias"),
             "<bubblesim:antialias> is '" + antialias + "', it must be true or false");
    }
    return description;
  }

 private:
  std::optional<SensorKind> read_only_camera() { return read_camera(sensor_.child("camera")); }

  /// Gazebo accepts half a turn, for which the image plane would be infinite.
  double read_field_of_view(const SdfElement& camera) {
    constexpr double kWide = 3.1;
    constexpr double kWidest = 3.13;
    const double angle = camera.number("horizontal_fov");
    if (!(angle > kWide && angle <= M_PI + 1e-3)) return angle;
    const std::string taken = angle > kWidest ? ", using " + text(kWidest) : "";
    warn(camera.source("horizontal_fov"), "the horizontal field of view is " + text(angle) + " rad" + taken +
                                              ": objects ahead are tiny in such an image");
    return std::min(angle, kWidest);
  }

  std::optional<SensorKind> read_lidar() {
    const SdfElement lidar = sensor_.child(sensor_.has("lidar") ? "lidar" : "ray");
    const SdfElement scan = lidar.child("scan");
    const SdfElement range = lidar.child("range");
    LidarDescription description;
    description.horizontal = read_angles(scan.child("horizontal"));
    sort(description.horizontal, "horizontal", lidar.source());
    description.vertical = read_angles(scan.child("vertical"));
    straighten(description.vertical, lidar.source());
    description.min_range = range.number("min");
    description.max_range = range.number("max");
    // Some models have a resolution that would leave no range.
    const double resolution = range.number("resolution");
    description.resolution = resolution < description.max_range ? resolution : 0;
    description.noise = read_noise(lidar.child("noise"));
    description.signal = own_text(lidar, "bubblesim:signal").value_or("");
    return description;
  }

  /// Like Gazebo: rings in any order; a single ring, or none, is horizontal.
  void straighten(ScanAngles& vertical, const Source& source) {
    if (vertical.samples > 1 || (vertical.samples == 1 && vertical.min == vertical.max)) {
      return sort(vertical, "vertical", source);
    }
    warn(source, std::to_string(vertical.samples) + " vertical samples from " + range_of(vertical) +
                     ": using a single ring at 0 rad");
    vertical = {1, 0, 0};
  }

  void sort(ScanAngles& angles, const std::string& which, const Source& source) {
    if (!(angles.min > angles.max)) return;
    warn(source, "the " + which + " angles are " + range_of(angles) + ": using them from low to high");
    std::swap(angles.min, angles.max);
  }

  static std::string range_of(const ScanAngles& angles) {
    return text(angles.min) + " to " + text(angles.max) + " rad";
  }

  std::optional<SensorKind> read_sonar() {
    const SdfElement element = sensor_.child("sonar");
    if (!element) {
      report(sensor_.source(), "a sonar needs a <sonar> element with <min>, <max> and <radius>");
      return std::nullopt;
    }
    SonarDescription sonar;
    sonar.min_range = element.number("min");
    sonar.max_range = element.number("max");
    sonar.half_angle = std::atan2(element.number("radius"), sonar.max_range);  // radius at max
    const auto volume = read_choice<ProximityVolume>(element, "bubblesim:volume",
                                                     {{"ray", ProximityVolume::kRay},
                                                      {"cone", ProximityVolume::kCone},
                                                      {"pyramid", ProximityVolume::kPyramid},
                                                      {"disc", ProximityVolume::kDisc},
                                                      {"cylinder", ProximityVolume::kCylinder}});
    if (!volume) return std::nullopt;
    sonar.volume = *volume;
    return sonar;
  }

  std::optional<SensorKind> read_imu() {
    const SdfElement imu = sensor_.child("imu");
    ImuDescription description;
    description.bandwidth = own_number(imu, "bubblesim:bandwidth", path_, context_).value_or(0);
    description.angular_velocity_noise = read_axes_noise(imu.child("angular_velocity"));
    description.linear_acceleration_noise = read_axes_noise(imu.child("linear_acceleration"));
    return description;
  }

  std::optional<SensorKind> read_navsat() {
    const SdfElement navsat = sensor_.child(sensor_.has("navsat") ? "navsat" : "gps");
    const auto noise_of = [&](const char* quantity, const char* direction) {
      return read_noise(navsat.child(quantity).child(direction).child("noise"));
    };
    NavSatDescription description;
    description.horizontal_position_noise = noise_of("position_sensing", "horizontal");
    description.vertical_position_noise = noise_of("position_sensing", "vertical");
    description.horizontal_velocity_noise = noise_of("velocity_sensing", "horizontal");
    description.vertical_velocity_noise = noise_of("velocity_sensing", "vertical");
    return description;
  }

  std::optional<SensorKind> read_altimeter() {
    const SdfElement altimeter = sensor_.child("altimeter");
    return AltimeterDescription{read_noise(altimeter.child("vertical_position").child("noise")),
                                read_noise(altimeter.child("vertical_velocity").child("noise"))};
  }

  std::optional<SensorKind> read_magnetometer() {
    return MagnetometerDescription{read_axes_noise(sensor_.child("magnetometer"))};
  }

  std::optional<SensorKind> read_contact() {
    ContactDescription description;
    for (const SdfElement& collision : sensor_.child("contact").children("collision")) {
      description.collisions.push_back(without_scope(collision.as_text()));
    }
    return description;
  }

  std::optional<SensorKind> read_force_torque() {
    using Frame = ForceTorqueDescription::Frame;
    const SdfElement element = sensor_.child("force_torque");
    ForceTorqueDescription description;
    description.bandwidth = own_number(element, "bubblesim:bandwidth", path_, context_).value_or(0);
    description.frame =
        read_choice<Frame>(element, "frame",
                           {{"child", Frame::kChild}, {"parent", Frame::kParent}, {"sensor", Frame::kSensor}})
            .value_or(Frame::kChild);
    description.of_child =
        read_choice<bool>(element, "measure_direction", {{"child_to_parent", true}, {"parent_to_child", false}})
            .value_or(true);
    description.force_noise = read_axes_noise(element.child("force"));
    description.torque_noise = read_axes_noise(element.child("torque"));
    return description;
  }

  /// The value that a child element names; another name is reported.
  template <class Value>
  std::optional<Value> read_choice(const SdfElement& element, const char* child,
                                   const std::vector<std::pair<std::string, Value>>& values) {
    const std::string given = element.text(child);
    std::vector<std::string> names;
    for (const auto& [name, value] : values) {
      if (name == given) return value;
      names.push_back(name);
    }
    report(element.source(child), "<" + std::string(child) + "> is '" + given + "', it must be " +
                                      list_of(names, " or ") + did_you_mean(given, names));
    return std::nullopt;
  }

  void report(const Source& source, std::string message) { context_.report(source, path_, std::move(message)); }
  void warn(const Source& source, std::string message) { context_.warn(source, path_, std::move(message)); }

  SdfElement sensor_;
  std::string type_;
  std::string path_;
  LoadContext& context_;
};

/// The text of the first of these elements that has one.
std::string first_text(const SdfElement& parent, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (parent.has(name) && !parent.text(name).empty()) return parent.text(name);
  }
  return "";
}

GzTopic read_gz_topic(const SdfElement& sensor) {
  const SdfElement camera = sensor.child("camera");
  GzTopic gz;
  for (const SdfElement& element : {sensor.child("contact"), sensor}) {
    gz.topic = first_text(element, {"topic"});
    if (gz.topic.rfind("__default", 0) == 0) gz.topic.clear();  // SDFormat's defaults
    if (!gz.topic.empty()) break;
  }
  gz.info_topic = first_text(camera, {"camera_info_topic"});
  gz.frame = first_text(camera, {"optical_frame_id"});
  if (gz.frame.empty()) gz.frame = first_text(sensor, {"gz_frame_id", "ignition_frame_id", "frame_id"});
  return gz;
}

/// All but the kind.
SensorDescription read_common(const SdfElement& sensor, const std::string& name, const std::string& path,
                              LoadContext& context) {
  SensorDescription description;
  description.name = name;
  description.alias = read_alias(sensor, path, context);
  description.type = type_of(sensor);
  description.gz = read_gz_topic(sensor);
  description.source = sensor.source();
  description.update_rate = sensor.number("update_rate");
  description.plugins = read_plugins(sensor);
  description.topic = own_text(sensor, "bubblesim:topic").value_or("");
  description.frame = own_text(sensor, "bubblesim:frame").value_or("");
  return description;
}

/// The pose of a camera is relative to that of its sensor.
Pose pose_of(const SdfElement& camera, const Pose& sensor_pose) { return sensor_pose * camera.child("pose").as_pose(); }

}  // namespace

std::optional<SensorDescription> read_sensor(const SdfElement& sensor, const std::string& name,
                                             const std::string& carrier_path, const Pose& pose, LoadContext& context) {
  const std::string path = carrier_path + "/" + name;
  SensorDescription description = read_common(sensor, name, path, context);
  const auto kind = KindReader(sensor, description.type, path, context).read();
  if (!kind) return std::nullopt;
  const bool is_camera = std::holds_alternative<CameraDescription>(*kind);
  description.kind = *kind;
  description.pose = is_camera ? pose_of(sensor.child("camera"), pose) : pose;
  return description;
}

bool is_multicamera(const SdfElement& sensor) { return type_of(sensor) == "multicamera"; }

std::vector<SensorDescription> read_multicamera(const SdfElement& sensor, const std::string& name,
                                                const std::string& carrier_path, const Pose& pose,
                                                LoadContext& context) {
  const std::string path = carrier_path + "/" + name;
  const SensorDescription common = read_common(sensor, name, path, context);
  KindReader reader(sensor, common.type, path, context);
  std::vector<SensorDescription> all;
  for (const SdfElement& camera : sensor.children("camera")) {
    SensorDescription& description = all.emplace_back(common);
    const std::string suffix = camera.name().empty() ? std::to_string(all.size()) : camera.name();
    description.name += "_" + suffix;
    for (std::string* topic : {&description.topic, &description.gz.topic}) {
      if (!topic->empty()) *topic += "/" + suffix;
    }
    description.pose = pose_of(camera, pose);
    description.kind = reader.read_camera(camera);
  }
  if (all.empty()) {
    context.report(sensor.source(), path, "a multicamera needs a <camera> for each of its cameras");
  }
  return all;
}

}  // namespace bubblesim
