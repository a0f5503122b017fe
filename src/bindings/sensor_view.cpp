// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_view.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

const char* volume_name(ProximityVolume volume) {
  switch (volume) {
    case ProximityVolume::kRay:
      return "ray";
    case ProximityVolume::kCone:
      return "cone";
    case ProximityVolume::kPyramid:
      return "pyramid";
    case ProximityVolume::kDisc:
      return "disc";
    case ProximityVolume::kCylinder:
      return "cylinder";
  }
  return "";
}

py::dict named(const char* kind) {
  py::dict dict;
  dict["kind"] = kind;
  return dict;
}

struct Parameters {
  py::dict operator()(const SonarDescription& sonar) const {
    py::dict dict = named("proximity");
    dict["min_range"] = sonar.min_range;
    dict["max_range"] = sonar.max_range;
    dict["half_angle"] = sonar.half_angle;
    dict["volume"] = volume_name(sonar.volume);
    return dict;
  }
  py::dict operator()(const LidarDescription& lidar) const {
    py::dict dict = named("lidar");
    dict["min_range"] = lidar.min_range;
    dict["max_range"] = lidar.max_range;
    dict["samples"] = lidar.horizontal.samples;
    dict["min_angle"] = lidar.horizontal.min;
    dict["max_angle"] = lidar.horizontal.max;
    dict["rings"] = lidar.vertical.samples;
    dict["min_elevation"] = lidar.vertical.min;
    dict["max_elevation"] = lidar.vertical.max;
    return dict;
  }
  py::dict operator()(const CameraDescription& camera) const {
    py::dict dict = named(camera.color ? "camera" : "depth_camera");
    dict["width"] = camera.width;
    dict["height"] = camera.height;
    dict["horizontal_fov"] = camera.horizontal_fov;
    dict["near"] = camera.near;
    dict["far"] = camera.far;
    return dict;
  }
  py::dict operator()(const ImuDescription&) const { return named("imu"); }
  py::dict operator()(const NavSatDescription&) const { return named("navsat"); }
  py::dict operator()(const AltimeterDescription&) const { return named("altimeter"); }
  py::dict operator()(const MagnetometerDescription&) const { return named("magnetometer"); }
  py::dict operator()(const ContactDescription&) const { return named("contact"); }
  py::dict operator()(const ForceTorqueDescription&) const { return named("force_torque"); }
};

}  // namespace

pybind11::dict sensor_parameters(const SensorKind& kind) { return std::visit(Parameters{}, kind); }

}  // namespace bubblesim::bindings
