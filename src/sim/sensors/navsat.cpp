// SPDX-License-Identifier: BSD-3-Clause
// Satellite navigation: position on the WGS84 ellipsoid and velocity. The scene is the tangent plane of the ellipsoid
// at the scene's origin; GeographicLib's LocalCartesian converts its points.
#include <GeographicLib/LocalCartesian.hpp>

#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"

namespace bubblesim {
namespace {

class NavSat final : public Sensor {
 public:
  NavSat(const NavSatDescription& description, const GeographicOrigin& origin, ObjectId id)
      : Sensor(NavSatReading{}),
        description_(description),
        id_(id),
        to_east_north_up_(from_rpy(0, 0, origin.heading)),
        earth_(origin.latitude, origin.longitude, origin.elevation) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    Vector3 place = to_east_north_up_ * moment.world.pose(id_).position;
    Vector3 velocity = to_east_north_up_ * moment.world.velocity(id_).linear;
    const NavSatDescription& d = description_;
    distort(place, {d.horizontal_position_noise, d.horizontal_position_noise, d.vertical_position_noise}, moment, id_,
            0);
    distort(velocity, {d.horizontal_velocity_noise, d.horizontal_velocity_noise, d.vertical_velocity_noise}, moment,
            id_, 3);
    NavSatReading reading;
    std::vector<double> turn(9);  // row-major, from east, north, up at this position to those at the origin
    earth_.Reverse(place.x(), place.y(), place.z(), reading.latitude, reading.longitude, reading.altitude, turn);
    // East, north and up at this position differ from those at the origin, because the Earth is round.
    reading.velocity = Eigen::Map<const Matrix3>(turn.data()) * velocity;  // its columns are the rows: the inverse
    measurement = reading;
  }

  NavSatDescription description_;
  ObjectId id_;
  Quaternion to_east_north_up_;
  GeographicLib::LocalCartesian earth_;
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const NavSatDescription& description, const SensorSite& site) {
  return std::make_unique<NavSat>(description, site.environment.origin, site.id);
}

}  // namespace bubblesim
