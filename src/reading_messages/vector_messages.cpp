// SPDX-License-Identifier: BSD-3-Clause
#include "vector_messages.hpp"

namespace bubblesim::reading_messages {

void imu(Fields& fields, const Header& header, const ImuReading& reading, const ImuVariances& variances) {
  put(fields, header);
  put(fields, "orientation", reading.orientation);
  put(fields, "orientation_covariance", variances.orientation);
  put(fields, "angular_velocity", reading.angular_velocity);
  put(fields, "angular_velocity_covariance", variances.angular_velocity);
  put(fields, "linear_acceleration", reading.linear_acceleration);
  put(fields, "linear_acceleration_covariance", variances.linear_acceleration);
}

void nav_sat_fix(Fields& fields, const Header& header, const NavSatReading& reading, const FixQuality& quality) {
  put(fields, header);
  fields.message("status", [&] {
    fields.put("status", quality.status);
    fields.put("service", quality.service);
  });
  fields.put("latitude", reading.latitude);
  fields.put("longitude", reading.longitude);
  fields.put("altitude", reading.altitude);
  put(fields, "position_covariance", quality.variances);
  fields.put("position_covariance_type", quality.variances_kind);
}

void magnetic_field(Fields& fields, const Header& header, const Vector3& field) {
  put(fields, header);
  put(fields, "magnetic_field", field);
}

void fluid_pressure(Fields& fields, const Header& header, double pressure, double variance) {
  put(fields, header);
  fields.put("fluid_pressure", pressure);
  fields.put("variance", variance);
}

void point(Fields& fields, const Header& header, const Vector3& point) {
  put(fields, header);
  put(fields, "point", point);
}

void vector(Fields& fields, const Header& header, const Vector3& vector) {
  put(fields, header);
  put(fields, "vector", vector);
}

void wrench(Fields& fields, const Header& header, const ForceTorqueReading& reading) {
  put(fields, header);
  fields.message("wrench", [&] {
    put(fields, "force", reading.force);
    put(fields, "torque", reading.torque);
  });
}

}  // namespace bubblesim::reading_messages
