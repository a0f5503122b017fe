// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "bubblesim/ros_home.hpp"

PYBIND11_MODULE(_core, core) {
  using namespace bubblesim::bindings;
  core.doc() = "The compiled part of bubblesim.";
  core.attr("__version__") = BUBBLESIM_VERSION;
  core.def("use_writable_ros_home", &bubblesim::use_writable_ros_home,
           "Let ROS write to a temporary folder if it cannot write to ~/.ros, and print that; return it, or ''.");
  bind_messages(core);
  bind_bridge(core);
  bind_plugins(core);
  bind_world(core);
  bind_object_frames(core);
  bind_devices(core);
  bind_control(core);
  bind_forces(core);
  bind_readings(core);
  bind_sensors(core);
  bind_reading_messages(core);
  bind_sensor_kinds(core);
  bind_objects(core);
  bind_scene(core);
  bind_simulation(core);
  bind_frame_memory(core);
  bind_randomization(core);
  bind_batch(core);
  bind_runner(core);
  bind_scene_elements(core);
  bind_scene_view(core);
  bind_editing(core);
  bind_cbor(core);
}
