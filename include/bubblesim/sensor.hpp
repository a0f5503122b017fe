// SPDX-License-Identifier: BSD-3-Clause
// Sensors and their measurements. A sensor returns a struct; publishing is done elsewhere. SI units; sensors look along
// their x axis, y to the left, z up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim {

class RayScene;

/// Measurement of a sonar or another proximity sensor. Lengths in metres, in the sensor's frame.
struct ProximityReading {
  bool detected = false;
  double distance = 0;
  Vector3 point;
  Vector3 normal;               ///< of the detected surface
  ObjectId object = kNoObject;  ///< the detected link
};

/// One scan of a lidar. Ring by ring, the lowest first; each ring starts at `horizontal.min`.
struct LidarScan {
  ScanAngles horizontal;
  ScanAngles vertical;
  double min_range = 0;
  double max_range = 0;
  std::vector<float> ranges;       ///< m, at least min_range; +Inf: nothing within max_range (REP 117)
  std::vector<float> intensities;  ///< laser_retro of the visual that was hit; 0: no hit
};

/// Metres, in the sensor's frame.
using Point = std::array<float, 3>;

/// Returns the points that the rays of a lidar hit, ring by ring; rays without a hit are left out.
std::vector<Point> to_point_cloud(const LidarScan& scan);

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
};

/// Measurement of an inertial measurement unit, in the sensor's frame (REP 145).
struct ImuReading {
  Quaternion orientation;       ///< of the sensor in the world, without noise
  Vector3 angular_velocity;     ///< rad/s
  Vector3 linear_acceleration;  ///< m/s^2, mean over the last step, with the reaction to gravity: +g at rest
};

/// Measurement of a satellite navigation receiver.
struct NavSatReading {
  double latitude = 0;   ///< degrees
  double longitude = 0;  ///< degrees
  double altitude = 0;   ///< m above the WGS84 ellipsoid
  Vector3 velocity;      ///< m/s, east, north, up
};

/// Measurement of an altimeter.
struct AltimeterReading {
  double height = 0;    ///< m above its initial position
  double velocity = 0;  ///< m/s upwards
};

/// Measurement of a magnetometer, in the sensor's frame.
struct MagnetometerReading {
  Vector3 field;  ///< T
};

/// Contacts of a link.
struct ContactReading {
  std::vector<Contact> contacts;
};

/// Force and torque that a joint transmits, with the axes and sign of the description; torque about the sensor's
/// origin.
struct ForceTorqueReading {
  Vector3 force;   ///< N, mean over the last step
  Vector3 torque;  ///< N m, mean over the last step
};

using Measurement = std::variant<ProximityReading, LidarScan, CameraImage, ImuReading, NavSatReading, AltimeterReading,
                                 MagnetometerReading, ContactReading, ForceTorqueReading>;

/// "proximity sensor", "lidar", "camera", "IMU", "GPS receiver", "altimeter", "magnetometer", "contact sensor" or
/// "force-torque sensor".
std::string_view kind_name(const Measurement& measurement);

struct Reading {
  double time = 0;  ///< s, simulation time of the measurement
  Measurement measurement;
};

/// Inputs of a measurement.
struct MeasurementContext {
  const World& world;
  RayScene& rays;
  double time = 0;         ///< s
  std::uint64_t seed = 0;  ///< of the simulation; noise depends on it, the sensor and the time only
};

class Sensor {
 public:
  virtual ~Sensor() = default;

  void update(const MeasurementContext& moment);
  /// Replaces the last measurement.
  void replace(double time, Measurement measurement);
  /// The last measurement. It does not change while a caller holds it; the next one is written to another buffer.
  std::shared_ptr<const Reading> reading() const { return reading_; }

 protected:
  /// `empty` determines the kind of measurement.
  explicit Sensor(Measurement empty);

 private:
  /// Measures into `measurement`, which holds an earlier measurement of the same kind.
  virtual void measure(const MeasurementContext& moment, Measurement& measurement) = 0;

  Measurement empty_;
  std::shared_ptr<Reading> reading_;
};

/// Creates the sensor of a description; `id` is its object in the world's tree.
std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, const Environment& environment, ObjectId id,
                                    const World& world);

}  // namespace bubblesim
