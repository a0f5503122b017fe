// SPDX-License-Identifier: BSD-3-Clause
// Messages of sensors that measure a few numbers.
#pragma once

#include <array>
#include <cstdint>

#include "bubblesim/sensor_kinds.hpp"
#include "parts.hpp"

namespace bubblesim::reading_messages {

struct ImuVariances {
  Variances<3> orientation{};          ///< rad^2
  Variances<3> angular_velocity{};     ///< rad^2/s^2
  Variances<3> linear_acceleration{};  ///< m^2/s^4
};

/// sensor_msgs/Imu.
void imu(Fields& fields, const Header& header, const ImuReading& reading, const ImuVariances& variances);

/// What a receiver reports about its fix: the values of sensor_msgs/NavSatStatus, and the variances of the position in
/// m^2 with their kind, a COVARIANCE_TYPE of sensor_msgs/NavSatFix.
struct FixQuality {
  std::int8_t status = 0;
  std::uint16_t service = 1;
  Variances<3> variances{};
  std::uint8_t variances_kind = 0;
};

/// sensor_msgs/NavSatFix.
void nav_sat_fix(Fields& fields, const Header& header, const NavSatReading& reading, const FixQuality& quality);

/// sensor_msgs/MagneticField, in tesla.
void magnetic_field(Fields& fields, const Header& header, const Vector3& field);

/// sensor_msgs/FluidPressure: Pa, and the variance in Pa^2.
void fluid_pressure(Fields& fields, const Header& header, double pressure, double variance);

/// geometry_msgs/PointStamped.
void point(Fields& fields, const Header& header, const Vector3& point);

/// geometry_msgs/Vector3Stamped.
void vector(Fields& fields, const Header& header, const Vector3& vector);

/// geometry_msgs/WrenchStamped.
void wrench(Fields& fields, const Header& header, const ForceTorqueReading& reading);

}  // namespace bubblesim::reading_messages
