// SPDX-License-Identifier: BSD-3-Clause
// The functions that read sensors.
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "bubblesim/simulation.hpp"
#include "guarded.hpp"
#include "numpy_values.hpp"
#include "object_view.hpp"
#include "sensors/record_class.hpp"
#include "world/object_axes.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// Throws WrongObject if the sensor is of another kind.
py::object reading_of_kind(const SensorDefinition& kind, const Simulation& simulation, ObjectId sensor,
                           std::shared_ptr<const Reading> reading) {
  const Measurement& measured = reading->measurement;
  if (measured.table() == kind.reading) return to_python(std::move(reading));
  throw WrongObject(simulation.world().tree().short_path(sensor) + " is " + with_article(definition_of(measured).name) +
                    ", not " + with_article(kind.name));
}

/// read_KIND() and measure_KIND() of a kind of sensor.
void bind_kind(Guarded<py::module_>& module, const SensorDefinition& kind) {
  module.def(("read_" + kind.reader).c_str(),
             [&kind](Simulation& s, ObjectId sensor) { return reading_of_kind(kind, s, sensor, s.read(sensor)); },
             ("Return the " + kind.name + "'s last reading.").c_str());
  module.def(("measure_" + kind.reader).c_str(),
             [&kind](Simulation& s, ObjectId sensor) { return reading_of_kind(kind, s, sensor, s.measure(sensor)); },
             ("Measure now and return the " + kind.name + "'s reading.").c_str());
}

/// In the sensor's axes as scripts see them.
py::tuple proximity_tuple(const Simulation& simulation, ObjectId sensor, const ProximityReading& r) {
  const Quaternion axes = object_axes(simulation.world(), sensor);
  return py::make_tuple(r.detected ? 1 : 0, r.distance, to_list(axes.conjugate() * r.point), r.object,
                        to_list(axes.conjugate() * r.normal));
}

py::tuple camera_optics(Simulation& simulation, ObjectId sensor) {
  const World& world = simulation.world();
  const std::string_view kind = simulation.sensor_kind(sensor);
  const auto* camera = world.models().sensor_description(sensor).kind.get_if<CameraDescription>();
  if (camera != nullptr) return py::make_tuple(camera->width, camera->height, camera->horizontal_fov);
  throw WrongObject(world.tree().short_path(sensor) + " is a " + std::string(kind) + ", not a camera");
}

}  // namespace

py::object last_reading(Simulation& simulation, ObjectId sensor) { return to_python(simulation.read(sensor)); }

void bind_sensors(py::module_& core) {
  Guarded<py::module_> module(core);
  for (const SensorDefinition* kind : sensor_definitions()) {
    if (!kind->reader.empty()) bind_kind(module, *kind);
  }
  module.def(
      "read_sensor",
      [](Simulation& s, ObjectId sensor) {
        std::shared_ptr<const Reading> reading = s.read(sensor);
        const double time = reading->time;
        return py::make_tuple(time, to_python(std::move(reading)));
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
      "override_image",
      [](Simulation& s, ObjectId camera, const py::bytes& rgb) {
        const std::string_view bytes = rgb;
        s.override_image(camera, {bytes.begin(), bytes.end()});
      },
      "Replace a camera's image by a picture, three bytes per pixel from the top row down.");
  module.def(
      "sensor_kind", [](Simulation& s, ObjectId sensor) { return std::string(s.sensor_kind(sensor)); },
      "Return the name of the sensor's kind, such as 'proximity sensor' or 'IMU'.");
  module.def("camera_optics", &camera_optics,
             "Return a camera's width and height in pixels and its horizontal field of view, rad; do not measure.");
}

}  // namespace bubblesim::bindings
