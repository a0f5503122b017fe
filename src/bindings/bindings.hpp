// SPDX-License-Identifier: BSD-3-Clause
// The parts of the Python module bubblesim._core, one bind_<concept>.cpp each.
#pragma once

#include <pybind11/pybind11.h>

namespace bubblesim::bindings {

void bind_messages(pybind11::module_& core);
void bind_added_types(pybind11::module_& messages);
void bind_bridge(pybind11::module_& core);
void bind_cbor(pybind11::module_& core);
void bind_scene(pybind11::module_& core);
void bind_simulation(pybind11::module_& core);
void bind_batch(pybind11::module_& core);
void bind_randomization(pybind11::module_& core);
void bind_objects(pybind11::module_& core);
void bind_plugins(pybind11::module_& core);
void bind_world(pybind11::module_& core);
void bind_object_frames(pybind11::module_& core);
void bind_runner(pybind11::module_& core);
void bind_frame_memory(pybind11::module_& core);
void bind_editing(pybind11::module_& core);
void bind_scene_elements(pybind11::module_& core);
void bind_scene_view(pybind11::module_& core);
void bind_devices(pybind11::module_& core);
void bind_control(pybind11::module_& core);  // after the world
void bind_forces(pybind11::module_& core);
void bind_reading_messages(pybind11::module_& core);
void bind_readings(pybind11::module_& core);
void bind_sensors(pybind11::module_& core);
void bind_sensor_kinds(pybind11::module_& core);

}  // namespace bubblesim::bindings
