// SPDX-License-Identifier: BSD-3-Clause
// The descriptions and measurements of bubblesim's own kinds of sensors (sensor_definition.hpp: how to add others).
// SI units; sensors look along their x axis, y to the left, z up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/any_record.hpp"
#include "bubblesim/math.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {

/// Gaussian noise of a measured value: value + N(mean, stddev) + bias, rounded to multiples of `precision`. The bias is
/// drawn once, from N(bias_mean, bias_stddev).
struct NoiseDescription {
  double mean = 0;
  double stddev = 0;
  double bias_mean = 0;
  double bias_stddev = 0;
  double precision = 0;  ///< 0: not rounded

  static const MemberTable& members();
};

enum class ProximityVolume {
  kRay,       ///< a single ray
  kCone,      ///< round
  kPyramid,   ///< square cross-section, as wide and high as the cone
  kDisc,      ///< a flat fan to the left and right
  kCylinder,  ///< parallel rays, with the radius of the cone at its end
};

/// A sensor that measures the distance to the nearest surface in a volume.
struct SonarDescription {
  double min_range = 0;   ///< m, start of the rays: nearer surfaces are not detected
  double max_range = 1;   ///< m
  double half_angle = 0;  ///< rad, between the axis and the volume's side
  ProximityVolume volume = ProximityVolume::kCone;
  double max_normal_angle = 0;         ///< rad, between a ray and the normal of a surface that it detects; 0: any
  std::vector<std::string> detects{};  ///< names of the links that it detects; empty: all

  static const MemberTable& members();
};

/// Measurement of a sonar or another proximity sensor. Lengths in metres, in the sensor's frame.
struct ProximityReading {
  bool detected = false;
  double distance = 0;
  Vector3 point;
  Vector3 normal;               ///< of the detected surface
  ObjectId object = kNoObject;  ///< the detected link

  static const MemberTable& members();
};

/// Angles of a scan: `samples` evenly spaced angles from `min` to `max`, both included; a single sample lies at `min`.
struct ScanAngles {
  int samples = 1;
  double min = 0;  ///< rad
  double max = 0;  ///< rad

  double at(int i) const { return samples > 1 ? min + (max - min) * i / (samples - 1) : min; }
  /// rad, between two samples; 0 for a single one
  double increment() const { return samples > 1 ? (max - min) / (samples - 1) : 0; }

  static const MemberTable& members();
};

struct LidarDescription {
  ScanAngles horizontal;  ///< about z, to the left
  ScanAngles vertical;    ///< upwards
  double min_range = 0;   ///< m, start of the rays: nearer surfaces are not detected
  double max_range = 1;   ///< m
  double resolution = 0;  ///< m; ranges are rounded to multiples of it, 0: not rounded
  NoiseDescription noise;
  std::string signal;  ///< name of the string signal that holds the points for child scripts; empty: none

  static const MemberTable& members();
};

/// One scan of a lidar. Ring by ring, the lowest first; each ring starts at `horizontal.min`.
struct LidarScan {
  ScanAngles horizontal;
  ScanAngles vertical;
  double min_range = 0;
  double max_range = 0;
  std::vector<float> ranges;       ///< m, at least min_range; +Inf: nothing within max_range (REP 117)
  std::vector<float> intensities;  ///< laser_retro of the visual that was hit; 0: no hit

  static const MemberTable& members();
};

/// Metres, in the sensor's frame.
using Point = std::array<float, 3>;

/// Returns the points that the rays of a lidar hit, ring by ring; rays without a hit are left out.
std::vector<Point> to_point_cloud(const LidarScan& scan);

/// A camera that looks along x, with y to the left and z up: a pinhole, or parallel rays.
struct CameraDescription {
  int width = 320;                ///< pixels
  int height = 240;               ///< pixels
  double horizontal_fov = 1.047;  ///< rad
  double orthographic_width = 0;  ///< m that the image shows from left to right, by parallel rays; 0: a pinhole
  double near = 0.1;              ///< m along the axis
  double far = 100;               ///< m along the axis
  bool color = true;              ///< false: depth camera
  bool antialias = false;         ///< four rays per pixel
  NoiseDescription noise;         ///< of each colour value (0 to 1), or of the depth in m when color is false

  static const MemberTable& members();
};

/// Image of a camera, row by row from the top, each row from left to right.
struct CameraImage {
  int width = 0;
  int height = 0;
  double horizontal_fov = 0;      ///< rad
  double near = 0;                ///< m along the axis
  double far = 0;                 ///< m along the axis
  std::vector<std::uint8_t> rgb;  ///< three bytes per pixel; empty for a depth camera
  std::vector<float> depth;       ///< m along the axis, at least `near`; +Inf beyond `far` (REP 117)
  std::vector<ObjectId> objects;  ///< visible link, or kNoObject

  static const MemberTable& members();
};

/// Axes of a camera's point cloud: those of the sensor, or z forward and x to the right (REP 103).
enum class CloudAxes { kSensor, kOptical };

/// Floats per pixel of a camera's point cloud: x, y and z in metres, and the colour in the fifth as the bytes blue,
/// green, red and 0, as PCL's PointXYZRGB. The others are 0.
constexpr std::size_t kCloudFloats = 8;

/// Writes the points of an image's pixels, kCloudFloats floats for each, to `points`, which need not be aligned. Those
/// whose depth is not between `least` and `most` (m) are NaN. Returns whether no point is NaN.
bool to_point_cloud(const CameraImage& image, double least, double most, CloudAxes axes, std::uint8_t* points);

/// An inertial measurement unit; noise along x, y, z.
struct ImuDescription {
  std::array<NoiseDescription, 3> angular_velocity_noise;     ///< rad/s
  std::array<NoiseDescription, 3> linear_acceleration_noise;  ///< m/s^2
  double bandwidth = 0;                                       ///< Hz, of a first-order low-pass filter; 0: none

  static const MemberTable& members();
};

/// Measurement of an inertial measurement unit, in the sensor's frame (REP 145).
struct ImuReading {
  Quaternion orientation;    ///< of the sensor in the world, without noise
  Vector3 angular_velocity;  ///< rad/s
  Vector3
      linear_acceleration;  ///< m/s^2, mean over the last step or filtered, with the reaction to gravity: +g at rest

  static const MemberTable& members();
};

/// A satellite navigation (GPS) receiver.
struct NavSatDescription {
  NoiseDescription horizontal_position_noise;  ///< m, east and north
  NoiseDescription vertical_position_noise;    ///< m
  NoiseDescription horizontal_velocity_noise;  ///< m/s, east and north
  NoiseDescription vertical_velocity_noise;    ///< m/s

  static const MemberTable& members();
};

/// Measurement of a satellite navigation receiver.
struct NavSatReading {
  double latitude = 0;   ///< degrees
  double longitude = 0;  ///< degrees
  double altitude = 0;   ///< m above the WGS84 ellipsoid
  Vector3 velocity;      ///< m/s, east, north, up

  static const MemberTable& members();
};

/// Measures the height above its start position.
struct AltimeterDescription {
  NoiseDescription position_noise;  ///< m
  NoiseDescription velocity_noise;  ///< m/s

  static const MemberTable& members();
};

/// Measurement of an altimeter.
struct AltimeterReading {
  double height = 0;    ///< m above its initial position
  double velocity = 0;  ///< m/s upwards

  static const MemberTable& members();
};

/// Measures the magnetic field; noise along x, y, z.
struct MagnetometerDescription {
  std::array<NoiseDescription, 3> field_noise;  ///< T

  static const MemberTable& members();
};

/// Measurement of a magnetometer, in the sensor's frame.
struct MagnetometerReading {
  Vector3 field;  ///< T

  static const MemberTable& members();
};

/// Measures the pressure of the air.
struct AirPressureDescription {
  double reference_altitude = 0;    ///< m above the sea, of the world's origin
  NoiseDescription pressure_noise;  ///< Pa

  static const MemberTable& members();
};

/// Measurement of a barometer.
struct AirPressureReading {
  double pressure = 0;  ///< Pa

  static const MemberTable& members();
};

/// Finds the models in its field of view, without regard to what hides them.
struct LogicalCameraDescription {
  double near = 0;            ///< m ahead
  double far = 1;             ///< m ahead
  double aspect_ratio = 1;    ///< width by height
  double horizontal_fov = 1;  ///< rad

  static const MemberTable& members();
};

/// A model with its origin in the field of view of a logical camera; in the sensor's frame.
struct SeenModel {
  ObjectId model = kNoObject;
  std::string name;
  Vector3 position;  ///< m
  Quaternion orientation = Quaternion::Identity();

  static const MemberTable& members();
};

/// Measurement of a logical camera.
struct LogicalCameraReading {
  std::vector<SeenModel> models;  ///< without its own

  static const MemberTable& members();
};

/// Measures the contacts of its link.
struct ContactDescription {
  std::vector<std::string> collisions;  ///< names of collisions of the link; empty: all

  static const MemberTable& members();
};

inline bool watches(const ContactDescription& sensor, const std::string& collision) {
  return sensor.collisions.empty() ||
         std::find(sensor.collisions.begin(), sensor.collisions.end(), collision) != sensor.collisions.end();
}

/// A contact point of two shapes; world axes.
struct ContactPoint {
  Vector3 position;  ///< m
  Vector3 normal;    ///< direction in which the other shape pushes
  double depth = 0;  ///< m
  Vector3 force;     ///< N, in the last physics substep with contact

  static const MemberTable& members();
};

/// A contact between a shape of a link and another shape during the last step.
struct Contact {
  std::string collision;
  ObjectId other_link = kNoObject;
  std::string other_collision;
  Vector3 force;                     ///< N on the link, mean over the step
  std::vector<ContactPoint> points;  ///< of the last physics substep with contact

  static const MemberTable& members();
};

/// Contacts of a link.
struct ContactReading {
  std::vector<Contact> contacts;

  static const MemberTable& members();
};

/// Measures the force and torque that a joint transmits.
struct ForceTorqueDescription {
  enum class Frame { kChild, kParent, kSensor };

  Frame frame = Frame::kChild;  ///< axes of the readings
  bool of_child = true;         ///< true: wrench of the child on the parent; false: of the parent on the child
  std::array<NoiseDescription, 3> force_noise;   ///< N
  std::array<NoiseDescription, 3> torque_noise;  ///< N m
  double bandwidth = 0;                          ///< Hz, of a first-order low-pass filter; 0: none

  static const MemberTable& members();
};

/// Force and torque that a joint transmits, with the axes and sign of the description; torque about the sensor's
/// origin.
struct ForceTorqueReading {
  Vector3 force;   ///< N, mean over the last step or filtered
  Vector3 torque;  ///< N m, mean over the last step

  static const MemberTable& members();
};

/// Which kind of sensor, with its parameters: holds the description of a kind.
class SensorKind : public AnyRecord {
 public:
  using AnyRecord::AnyRecord;
  using AnyRecord::operator=;
};

/// Holds the reading of a kind.
class Measurement : public AnyRecord {
 public:
  using AnyRecord::AnyRecord;
  using AnyRecord::operator=;
};

}  // namespace bubblesim
