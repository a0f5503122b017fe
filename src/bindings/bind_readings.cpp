// SPDX-License-Identifier: BSD-3-Clause
// Sensor readings; their numpy arrays are views of the measurement.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "held_readings.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// A read-only array on memory that `owner` keeps alive.
template <class Value>
py::array view(const std::vector<Value>& values, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array array(py::dtype::of<Value>(), std::move(shape), values.data(), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array in_rings(const std::vector<float>& values, const py::object& scan) {
  const auto& held = scan.cast<const HeldScan&>();
  return view(values, {held->vertical.samples, held->horizontal.samples}, scan);
}

py::array_t<double> angles(const ScanAngles& scan) {
  py::array_t<double> array(scan.samples);
  for (int i = 0; i < scan.samples; ++i) array.mutable_at(i) = scan.at(i);
  return array;
}

template <class Value>
py::array in_pixels(const std::vector<Value>& values, const py::object& image) {
  const auto& held = image.cast<const HeldImage&>();
  return view(values, {held->height, held->width}, image);
}

void bind_proximity(py::module_& module) {
  py::class_<ProximityReading>(module, "ProximityReading",
                               "Reading of a proximity sensor, in its own frame: it measures along x.")
      .def_readonly("detected", &ProximityReading::detected)
      .def_readonly("distance", &ProximityReading::distance, "Metres; 0 if nothing was detected.")
      .def_property_readonly("point", [](const ProximityReading& r) { return to_numpy(r.point); })
      .def_property_readonly("normal", [](const ProximityReading& r) { return to_numpy(r.normal); })
      .def_readonly("handle", &ProximityReading::object, "Handle of the detected link, or -1.");
}

void bind_scan(py::module_& module) {
  py::class_<HeldScan>(module, "LidarScan",
                       "One turn of a lidar, ring by ring from the lowest up. Its arrays are read-only.")
      .def_property_readonly(
          "time", [](const HeldScan& s) { return s.reading->time; }, "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "ranges", [](const py::object& s) { return in_rings(s.cast<const HeldScan&>()->ranges, s); },
          "Metres, rings x samples of float32: at least min_range; inf if nothing is in range.")
      .def_property_readonly(
          "intensities", [](const py::object& s) { return in_rings(s.cast<const HeldScan&>()->intensities, s); },
          "The laser_retro of the hit shape, 0 for none; rings x samples of float32.")
      .def_property_readonly(
          "points",
          [](const HeldScan& s) {
            const std::vector<Point> points = to_point_cloud(*s);
            py::array_t<float> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
            std::copy(points.begin(), points.end(), reinterpret_cast<Point*>(array.mutable_data()));
            return array;
          },
          "The hit points: x, y, z in metres in the sensor's frame; count x 3 of float32, ring by ring. A new array.")
      .def_property_readonly(
          "angles", [](const HeldScan& s) { return angles(s->horizontal); },
          "Angles of the samples, radians to the left.")
      .def_property_readonly(
          "angle_min", [](const HeldScan& s) { return s->horizontal.min; },
          "Angle of the first sample, radians to the left.")
      .def_property_readonly(
          "angle_max", [](const HeldScan& s) { return s->horizontal.max; },
          "Angle of the last sample, radians to the left.")
      .def_property_readonly(
          "angle_increment",
          [](const HeldScan& s) {
            const ScanAngles& angles = s->horizontal;
            return angles.samples > 1 ? (angles.max - angles.min) / (angles.samples - 1) : 0.0;
          },
          "Angle between samples, radians.")
      .def_property_readonly(
          "elevations", [](const HeldScan& s) { return angles(s->vertical); },
          "Elevations of the rings, radians upwards.")
      .def_property_readonly(
          "min_range", [](const HeldScan& s) { return s->min_range; }, "Metres.")
      .def_property_readonly(
          "max_range", [](const HeldScan& s) { return s->max_range; }, "Metres.");
}

void bind_image(py::module_& module) {
  py::class_<HeldImage>(module, "CameraImage", "Image of a camera, top row first. Its arrays are read-only.")
      .def_property_readonly(
          "time", [](const HeldImage& i) { return i.reading->time; }, "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "rgb",
          [](const py::object& image) -> py::object {
            const auto& held = image.cast<const HeldImage&>();
            if (held->rgb.empty()) return py::none();
            return view(held->rgb, {held->height, held->width, 3}, image);
          },
          "height x width x 3 of uint8; None for a depth camera.")
      .def_property_readonly(
          "depth", [](const py::object& i) { return in_pixels(i.cast<const HeldImage&>()->depth, i); },
          "Metres along the optical axis, height x width of float32: at least the near plane; inf beyond the far "
          "plane.")
      .def_property_readonly(
          "objects", [](const py::object& i) { return in_pixels(i.cast<const HeldImage&>()->objects, i); },
          "Handles of the visible links, -1 for none; height x width of int32.")
      .def_property_readonly(
          "horizontal_fov", [](const HeldImage& i) { return i->horizontal_fov; }, "Radians.")
      .def_property_readonly(
          "near", [](const HeldImage& i) { return i->near; }, "Near plane, metres along the optical axis.")
      .def_property_readonly(
          "far", [](const HeldImage& i) { return i->far; }, "Far plane, metres along the optical axis.");
}

void bind_imu(py::module_& module) {
  py::class_<HeldImu>(module, "ImuReading", "Reading of an IMU, in its own frame (REP 145).")
      .def_property_readonly(
          "time", [](const HeldImu& i) { return i.reading->time; }, "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "orientation", [](const HeldImu& i) { return to_numpy(i->orientation); },
          "Orientation of the sensor in the world, exact; quaternion x, y, z, w.")
      .def_property_readonly(
          "angular_velocity", [](const HeldImu& i) { return to_numpy(i->angular_velocity); }, "rad/s.")
      .def_property_readonly(
          "linear_acceleration", [](const HeldImu& i) { return to_numpy(i->linear_acceleration); },
          "Proper acceleration, m/s^2, the mean over the last step; at rest, gravity's magnitude upwards.");
}

void bind_navsat(py::module_& module) {
  py::class_<HeldNavSat>(module, "NavSatReading", "Reading of a GPS receiver.")
      .def_property_readonly(
          "time", [](const HeldNavSat& n) { return n.reading->time; }, "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "latitude", [](const HeldNavSat& n) { return n->latitude; }, "Degrees.")
      .def_property_readonly(
          "longitude", [](const HeldNavSat& n) { return n->longitude; }, "Degrees.")
      .def_property_readonly(
          "altitude", [](const HeldNavSat& n) { return n->altitude; }, "Metres above the WGS84 ellipsoid.")
      .def_property_readonly(
          "velocity", [](const HeldNavSat& n) { return to_numpy(n->velocity); }, "m/s east, north and up.");
}

void bind_altimeter(py::module_& module) {
  py::class_<HeldAltimeter>(module, "AltimeterReading", "Reading of an altimeter.")
      .def_property_readonly(
          "time", [](const HeldAltimeter& a) { return a.reading->time; },
          "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "height", [](const HeldAltimeter& a) { return a->height; }, "Metres above the sensor's initial position.")
      .def_property_readonly(
          "velocity", [](const HeldAltimeter& a) { return a->velocity; }, "m/s upwards.");
}

void bind_magnetometer(py::module_& module) {
  py::class_<HeldMagnetometer>(module, "MagnetometerReading", "Reading of a magnetometer, in its own frame.")
      .def_property_readonly(
          "time", [](const HeldMagnetometer& m) { return m.reading->time; },
          "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "field", [](const HeldMagnetometer& m) { return to_numpy(m->field); }, "T.");
}

void bind_contacts(py::module_& module) {
  py::class_<ContactPoint>(module, "ContactPoint", "Contact point of two shapes; world axes.")
      .def_property_readonly(
          "position", [](const ContactPoint& p) { return to_numpy(p.position); }, "Metres.")
      .def_property_readonly(
          "normal", [](const ContactPoint& p) { return to_numpy(p.normal); },
          "Direction in which the other shape pushes.")
      .def_property_readonly(
          "force", [](const ContactPoint& p) { return to_numpy(p.force); },
          "N, in the physics substep of their last contact.")
      .def_readonly("depth", &ContactPoint::depth, "Penetration depth, metres.");
  py::class_<Contact>(module, "Contact",
                      "A contact of one of the link's shapes with another shape during the last step.")
      .def_readonly("collision", &Contact::collision, "Name of the link's shape.")
      .def_readonly("other", &Contact::other_link, "Handle of the other link.")
      .def_readonly("other_collision", &Contact::other_collision, "Name of that link's shape.")
      .def_property_readonly(
          "force", [](const Contact& c) { return to_numpy(c.force); },
          "Force on the sensor's link, N in world axes, the mean over the step.")
      .def_readonly("points", &Contact::points, "Contact points in the physics substep of their last contact.");
  py::class_<HeldContacts>(module, "ContactReading", "Contacts of a link.")
      .def_property_readonly(
          "time", [](const HeldContacts& c) { return c.reading->time; },
          "Simulated seconds of the state that it shows.")
      .def_property_readonly("contacts", [](const HeldContacts& c) { return c->contacts; });
}

void bind_force_torque(py::module_& module) {
  py::class_<HeldForceTorque>(module, "ForceTorqueReading",
                              "Force and torque that a joint transmits, the mean over the last step.")
      .def_property_readonly(
          "time", [](const HeldForceTorque& f) { return f.reading->time; },
          "Simulated seconds of the state that it shows.")
      .def_property_readonly(
          "force", [](const HeldForceTorque& f) { return to_numpy(f->force); }, "N.")
      .def_property_readonly(
          "torque", [](const HeldForceTorque& f) { return to_numpy(f->torque); }, "N m, about the sensor's origin.");
}

}  // namespace

void bind_readings(py::module_& core) {
  bind_proximity(core);
  bind_scan(core);
  bind_image(core);
  bind_imu(core);
  bind_navsat(core);
  bind_altimeter(core);
  bind_magnetometer(core);
  bind_contacts(core);
  bind_force_torque(core);
}

}  // namespace bubblesim::bindings
