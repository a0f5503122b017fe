// SPDX-License-Identifier: BSD-3-Clause
// The functions that read sensors.
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <variant>

#include "bindings.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "guarded.hpp"
#include "held_readings.hpp"
#include "numpy_values.hpp"
#include "object_axes.hpp"
#include "object_view.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// Throws WrongObject if the sensor is of another kind.
template <class Kind>
Held<Kind> hold(const Simulation& simulation, ObjectId sensor, std::shared_ptr<const Reading> reading) {
  if (std::holds_alternative<Kind>(reading->measurement)) return {std::move(reading)};
  throw WrongObject(simulation.world().tree().short_path(sensor) + " is a " +
                    std::string(kind_name(reading->measurement)) + ", not a " + std::string(Kind::kName));
}

struct ToPython {
  const std::shared_ptr<const Reading>& reading;

  py::object operator()(const ProximityReading& proximity) const { return py::cast(proximity); }
  template <class Kind>
  py::object operator()(const Kind&) const {
    return py::cast(Held<Kind>{reading});
  }
};

/// In the sensor's axes as scripts see them.
py::tuple proximity_tuple(const Simulation& simulation, ObjectId sensor, const ProximityReading& r) {
  const Quaternion axes = object_axes(simulation.world(), sensor);
  return py::make_tuple(r.detected ? 1 : 0, r.distance, to_list(axes.conjugate() * r.point), r.object,
                        to_list(axes.conjugate() * r.normal));
}

py::tuple camera_optics(Simulation& simulation, ObjectId sensor) {
  const World& world = simulation.world();
  const std::string_view kind = simulation.sensor_kind(sensor);
  const auto* camera = std::get_if<CameraDescription>(&world.sensor_description(sensor).kind);
  if (camera != nullptr) return py::make_tuple(camera->width, camera->height, camera->horizontal_fov);
  throw WrongObject(world.tree().short_path(sensor) + " is a " + std::string(kind) + ", not a camera");
}

}  // namespace

py::object last_reading(Simulation& simulation, ObjectId sensor) {
  const std::shared_ptr<const Reading> reading = simulation.read(sensor);
  return std::visit(ToPython{reading}, reading->measurement);
}

void bind_sensors(py::module_& core) {
  Guarded module(core);
  module.def(
      "read_sensor",
      [](Simulation& s, ObjectId sensor) {
        const std::shared_ptr<const Reading> reading = s.read(sensor);
        return std::make_pair(reading->time, std::visit(ToPython{reading}, reading->measurement));
      },
      "Return the last reading of a sensor of any kind: (simulated seconds, reading).");
  module.def(
      "read_proximity",
      [](Simulation& s, ObjectId sensor) { return proximity_tuple(s, sensor, s.read_proximity(sensor)); },
      "Return the last reading as (detected, distance, point, handle, normal), with the axes of ObjectFrames.");
  module.def(
      "measure_proximity",
      [](Simulation& s, ObjectId sensor) { return proximity_tuple(s, sensor, s.measure_proximity(sensor)); },
      "Measure now; return the same as read_proximity().");
  module.def(
      "reading_time", [](Simulation& s, ObjectId sensor) { return s.reading_time(sensor); },
      "Return the state_time of the last measurement, or without readers of when it was last due; do not measure.");
  module.def(
      "read_lidar", [](Simulation& s, ObjectId sensor) { return hold<LidarScan>(s, sensor, s.read(sensor)); },
      "Return the lidar's last scan.");
  module.def(
      "measure_lidar", [](Simulation& s, ObjectId sensor) { return hold<LidarScan>(s, sensor, s.measure(sensor)); },
      "Measure now and return the lidar's scan.");
  module.def(
      "read_imu", [](Simulation& s, ObjectId sensor) { return hold<ImuReading>(s, sensor, s.read(sensor)); },
      "Return the IMU's last reading.");
  module.def(
      "read_navsat", [](Simulation& s, ObjectId sensor) { return hold<NavSatReading>(s, sensor, s.read(sensor)); },
      "Return the receiver's last reading.");
  module.def(
      "read_altimeter",
      [](Simulation& s, ObjectId sensor) { return hold<AltimeterReading>(s, sensor, s.read(sensor)); },
      "Return the altimeter's last reading.");
  module.def(
      "read_magnetometer",
      [](Simulation& s, ObjectId sensor) { return hold<MagnetometerReading>(s, sensor, s.read(sensor)); },
      "Return the magnetometer's last reading.");
  module.def(
      "read_contacts", [](Simulation& s, ObjectId sensor) { return hold<ContactReading>(s, sensor, s.read(sensor)); },
      "Return the last contacts of the sensor's link.");
  module.def(
      "read_force_torque",
      [](Simulation& s, ObjectId sensor) { return hold<ForceTorqueReading>(s, sensor, s.read(sensor)); },
      "Return the last force and torque of the sensor's joint.");
  module.def(
      "override_image",
      [](Simulation& s, ObjectId camera, const py::bytes& rgb) {
        const std::string_view bytes = rgb;
        s.override_image(camera, {bytes.begin(), bytes.end()});
      },
      "Replace a camera's image by a picture, three bytes per pixel from the top row down.");
  module.def(
      "sensor_kind", [](Simulation& s, ObjectId sensor) { return std::string(s.sensor_kind(sensor)); },
      "Return 'proximity sensor', 'lidar', 'camera', 'IMU', 'GPS receiver', 'altimeter', 'magnetometer', 'contact "
      "sensor' or 'force-torque sensor'.");
  module.def(
      "read_camera", [](Simulation& s, ObjectId sensor) { return hold<CameraImage>(s, sensor, s.read(sensor)); },
      "Return the camera's last image.");
  module.def("camera_optics", &camera_optics,
             "Return a camera's width and height in pixels and its horizontal field of view, rad; do not measure.");
  module.def(
      "measure_camera", [](Simulation& s, ObjectId sensor) { return hold<CameraImage>(s, sensor, s.measure(sensor)); },
      "Measure now and return the camera's image.");
}

}  // namespace bubblesim::bindings
