// SPDX-License-Identifier: BSD-3-Clause
// Satellite navigation: position on the WGS84 ellipsoid and velocity. The scene is the tangent plane of the ellipsoid
// at the scene's origin; GeographicLib's LocalCartesian converts its points.
#include <GeographicLib/LocalCartesian.hpp>

#include "bubblesim/sensor_noise.hpp"
#include "sensors/define.hpp"

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
  void measure(const MeasurementContext& context, Measurement& measurement) override {
    Vector3 place = to_east_north_up_ * context.world.pose(id_).position;
    Vector3 velocity = to_east_north_up_ * context.world.velocity(id_).linear;
    const NavSatDescription& d = description_;
    distort(place, {d.horizontal_position_noise, d.horizontal_position_noise, d.vertical_position_noise}, context, id_,
            0);
    distort(velocity, {d.horizontal_velocity_noise, d.horizontal_velocity_noise, d.vertical_velocity_noise}, context,
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

const MemberTable& NavSatDescription::members() {
  static const MemberTable table = member_table<NavSatDescription>(
      "NavSatDescription", "A satellite navigation (GPS) receiver.",
      {
          member<&NavSatDescription::horizontal_position_noise>("horizontal_position_noise", "m",
                                                                "noise east and north"),
          member<&NavSatDescription::vertical_position_noise>("vertical_position_noise", "m", "noise upwards"),
          member<&NavSatDescription::horizontal_velocity_noise>("horizontal_velocity_noise", "m/s",
                                                                "noise east and north"),
          member<&NavSatDescription::vertical_velocity_noise>("vertical_velocity_noise", "m/s", "noise upwards"),
      });
  return table;
}

const MemberTable& NavSatReading::members() {
  static const MemberTable table =
      member_table<NavSatReading>("NavSatReading", "Reading of a GPS receiver.",
                                  {
                                      member<&NavSatReading::latitude>("latitude", "degrees", "north"),
                                      member<&NavSatReading::longitude>("longitude", "degrees", "east"),
                                      member<&NavSatReading::altitude>("altitude", "m", "above the WGS84 ellipsoid"),
                                      member<&NavSatReading::velocity>("velocity", "m/s", "east, north and up"),
                                  });
  return table;
}

class NavSatKind final : public SensorDefinitionOf<NavSatDescription, NavSatReading> {
 public:
  NavSatKind() : SensorDefinitionOf("GPS receiver", {"navsat", "gps"}) {
    renamed = {{"gps", "navsat"}};
    elements = R"(
  gps none
    &navsat
  navsat none
    &navsat

=navsat
  position_sensing none
    horizontal none
      noise none
        &noise
    vertical none
      noise none
        &noise
  velocity_sensing none
    horizontal none
      noise none
        &noise
    vertical none
      noise none
        &noise
)";
    observe("geographic_position", "degrees, m", "latitude, longitude and altitude", Sizes{3},
            [](const NavSatReading& reading, Row& row) {
              for (const double value : {reading.latitude, reading.longitude, reading.altitude}) row.put(value);
            });
  }

  std::optional<NavSatDescription> read(SensorElement& sensor) const override {
    const std::string navsat = sensor.has("navsat") ? "navsat" : "gps";
    return NavSatDescription{sensor.noise(navsat + "/position_sensing/horizontal/noise"),
                             sensor.noise(navsat + "/position_sensing/vertical/noise"),
                             sensor.noise(navsat + "/velocity_sensing/horizontal/noise"),
                             sensor.noise(navsat + "/velocity_sensing/vertical/noise")};
  }

  std::unique_ptr<Sensor> make(const NavSatDescription& description, const SensorSite& site) const override {
    return std::make_unique<NavSat>(description, site.environment.origin, site.id);
  }
};

template std::unique_ptr<SensorDefinition> define<NavSatKind>();

}  // namespace bubblesim
