// SPDX-License-Identifier: BSD-3-Clause
// What sensors measure, and what a sensor is. A sensor returns a struct; who shows or publishes it is not its business.
// SI units; sensors look along their x axis, y to the left, z up.
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

/// What a sonar or another proximity sensor saw. Lengths in metres, in the sensor's frame.
struct ProximityReading {
  bool detected = false;
  double distance = 0;
  Vector3 point;
  Vector3 normal;               ///< of the surface seen
  ObjectId object = kNoObject;  ///< the link seen
};

/// One turn of a lidar. Ring by ring, the lowest first; in each ring from `horizontal.min` on.
struct LidarScan {
  ScanAngles horizontal;
  ScanAngles vertical;
  double min_range = 0;
  double max_range = 0;
  std::vector<float> ranges;       ///< m, from min_range on; +Inf for nothing within max_range (REP 117)
  std::vector<float> intensities;  ///< laser_retro of what was hit, 0 for nothing
};

/// Metres, in the sensor's frame.
using Point = std::array<float, 3>;

/// Where a lidar's rays met something, ring by ring; rays that met nothing are left out.
std::vector<Point> to_point_cloud(const LidarScan& scan);

/// What a camera saw, row by row, the uppermost first, each from left to right.
struct CameraImage {
  int width = 0;
  int height = 0;
  double horizontal_fov = 0;      ///< rad
  double near = 0;                ///< m along the axis
  double far = 0;                 ///< m along the axis
  std::vector<std::uint8_t> rgb;  ///< three bytes a pixel; empty for a depth camera
  std::vector<float> depth;       ///< m along the axis, from the near plane on; +Inf beyond the far one (REP 117)
  std::vector<ObjectId> objects;  ///< the link seen, or kNoObject
};

/// What an inertial measurement unit felt, in its own frame (REP 145).
struct ImuReading {
  Quaternion orientation;       ///< of the sensor in the world, exact
  Vector3 angular_velocity;     ///< rad/s
  Vector3 linear_acceleration;  ///< m/s^2, the mean over the last step, with what holds it against gravity: g at rest
};

/// Where a receiver of satellite navigation is and how it moves.
struct NavSatReading {
  double latitude = 0;   ///< degrees
  double longitude = 0;  ///< degrees
  double altitude = 0;   ///< m above the ellipsoid WGS84
  Vector3 velocity;      ///< m/s, to the east, to the north and up
};

/// How high an altimeter is.
struct AltimeterReading {
  double height = 0;    ///< m above where it was when it came into the world
  double velocity = 0;  ///< m/s upwards
};

/// What a magnetometer felt, in its own frame.
struct MagnetometerReading {
  Vector3 field;  ///< T
};

/// What a link touches.
struct ContactReading {
  std::vector<Contact> contacts;
};

/// What a joint transmits, in the axes and with the sign that the description says; torque about the sensor's origin.
struct ForceTorqueReading {
  Vector3 force;   ///< N, the mean over the last step
  Vector3 torque;  ///< N m, the mean over the last step
};

using Measurement = std::variant<ProximityReading, LidarScan, CameraImage, ImuReading, NavSatReading, AltimeterReading,
                                 MagnetometerReading, ContactReading, ForceTorqueReading>;

/// "proximity sensor", "lidar", "camera", "IMU", "GPS receiver", "altimeter", "magnetometer", "contact sensor" or
/// "force-torque sensor".
std::string_view kind_name(const Measurement& measurement);

struct Reading {
  double time = 0;  ///< s of simulation time at which it was measured
  Measurement measurement;
};

/// What a sensor measures from.
struct MeasurementContext {
  const World& world;
  RayScene& rays;
  double time = 0;         ///< s
  std::uint64_t seed = 0;  ///< of the simulation; noise follows from it, the sensor and the time alone
};

class Sensor {
 public:
  virtual ~Sensor() = default;

  void update(const MeasurementContext& moment);
  /// Takes what somebody gives it for what it has measured.
  void replace(double time, Measurement measurement);
  /// The last measurement. It stays as it is: the next one is written elsewhere as long as anybody holds it.
  std::shared_ptr<const Reading> reading() const { return reading_; }

 protected:
  /// `empty` tells which kind of measurement it makes.
  explicit Sensor(Measurement empty);

 private:
  /// Writes into `measurement`, which holds an earlier one of the same kind.
  virtual void measure(const MeasurementContext& moment, Measurement& measurement) = 0;

  Measurement empty_;
  std::shared_ptr<Reading> reading_;
};

/// Makes the sensor that a scene describes; `id` is its object in the world's tree.
std::unique_ptr<Sensor> make_sensor(const SensorDescription& description, const Environment& environment, ObjectId id,
                                    const World& world);

}  // namespace bubblesim
