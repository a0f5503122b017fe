// SPDX-License-Identifier: BSD-3-Clause
// Carries the phases of a pass over to the Python object that keeps the devices
// (bubblesim.gazebo_plugins.robots.Devices).
#include "bubblesim/devices.hpp"

#include "child_scripts_python.hpp"
#include "python_call.hpp"

namespace bubblesim {
namespace {

namespace py = pybind11;

template <class Action>
void with_devices(Simulation& simulation, Action action) {
  scripting::with_python(simulation, "the devices", action);
}

}  // namespace

struct Devices::Python {
  py::object devices;
  py::object actuate;  // looked up once, called in every pass
  py::object publish;
};

Devices::Devices(Simulation& simulation, const ChildScripts& scripts)
    : simulation_(simulation), python_(std::make_unique<Python>()) {
  with_devices(simulation, [&] {
    python_->devices = py::module_::import("bubblesim.gazebo_plugins.robots")
                           .attr("Devices")(py::cast(&simulation, py::return_value_policy::reference),
                                            scripts.python_->host.attr("bridge"));
    python_->actuate = python_->devices.attr("actuate");
    python_->publish = python_->devices.attr("publish");
  });
}

Devices::~Devices() {
  const py::gil_scoped_acquire gil;
  python_.reset();
}

void Devices::actuate(World&, double) {
  with_devices(simulation_, [&] { python_->actuate(); });
}

void Devices::publish(const World&, double) {
  with_devices(simulation_, [&] { python_->publish(); });
}

void Devices::reset() {
  with_devices(simulation_, [&] { python_->devices.attr("reset")(); });
}

void Devices::model_added(World&, ObjectId model) {
  with_devices(simulation_, [&] { python_->devices.attr("add_model")(model); });
}

void Devices::model_removing(World&, ObjectId model) {
  with_devices(simulation_, [&] { python_->devices.attr("remove_model")(model); });
}

}  // namespace bubblesim
