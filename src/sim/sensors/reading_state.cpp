// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/reading_state.hpp"

#include <variant>

namespace bubblesim {
namespace {

void transfer(StateArchive& archive, ScanAngles& angles) { archive(angles.samples, angles.min, angles.max); }

void transfer(StateArchive& archive, Contact& contact) {
  archive(contact.collision, contact.other_link, contact.other_collision, contact.force);
  contact.points.resize(archive.count(contact.points.size()));
  for (ContactPoint& point : contact.points) archive(point.position, point.normal, point.depth, point.force);
}

struct Transfer {
  StateArchive& archive;

  void operator()(ProximityReading& r) const { archive(r.detected, r.distance, r.point, r.normal, r.object); }
  void operator()(LidarScan& r) const {
    transfer(archive, r.horizontal);
    transfer(archive, r.vertical);
    archive(r.min_range, r.max_range, r.ranges, r.intensities);
  }
  void operator()(CameraImage& r) const {
    archive(r.width, r.height, r.horizontal_fov, r.near, r.far, r.rgb, r.depth, r.objects);
  }
  void operator()(ImuReading& r) const { archive(r.orientation, r.angular_velocity, r.linear_acceleration); }
  void operator()(NavSatReading& r) const { archive(r.latitude, r.longitude, r.altitude, r.velocity); }
  void operator()(AltimeterReading& r) const { archive(r.height, r.velocity); }
  void operator()(MagnetometerReading& r) const { archive(r.field); }
  void operator()(ContactReading& r) const {
    r.contacts.resize(archive.count(r.contacts.size()));
    for (Contact& contact : r.contacts) transfer(archive, contact);
  }
  void operator()(ForceTorqueReading& r) const { archive(r.force, r.torque); }
};

}  // namespace

void transfer(StateArchive& archive, Measurement& measurement) { std::visit(Transfer{archive}, measurement); }

}  // namespace bubblesim
