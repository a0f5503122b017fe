// SPDX-License-Identifier: BSD-3-Clause
// The classes of sensor readings (record_class.hpp), and what a list of members cannot give.
#include <pybind11/numpy.h>

#include <string>

#include "bindings.hpp"
#include "bubblesim/sensor_kinds.hpp"
#include "record_class.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

bool fill_cloud(const py::object& object, py::array_t<float, py::array::c_style>& points, double least, double most,
                bool optical) {
  const auto& image = record_of<CameraImage>(object);
  const py::ssize_t floats = py::ssize_t{kCloudFloats};
  if (points.ndim() != 3 || points.shape(0) != image.height || points.shape(1) != image.width ||
      points.shape(2) != floats) {
    throw py::value_error("the points of this image need an array of " + std::to_string(image.height) + " x " +
                          std::to_string(image.width) + " x " + std::to_string(floats) + " of float32");
  }
  return to_point_cloud(image, least, most, optical ? CloudAxes::kOptical : CloudAxes::kSensor, points.mutable_data());
}

}  // namespace

void bind_readings(py::module_& core) {
  bind_record_classes(core);
  const py::object image = class_of(CameraImage::members());
  image.attr("fill_cloud") = py::cpp_function(
      &fill_cloud, py::name("fill_cloud"), py::is_method(image), py::arg("points").noconvert(), py::arg("least"),
      py::arg("most"), py::arg("optical"),
      "Write the pixels' points to height x width x 8 of float32: x, y, z, 0, the colour's bytes and zeros, in the "
      "sensor's axes, or with z forward and x to the right. Points whose depth is not between two depths in metres "
      "are NaN. Return whether none is.");
}

}  // namespace bubblesim::bindings
