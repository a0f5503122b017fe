// SPDX-License-Identifier: BSD-3-Clause
// Calls the Python object that runs the Gazebo plugins in each phase of a step
// (bubblesim.gazebo_plugins.robots.GazeboPlugins).
#include "bubblesim/gazebo_plugins.hpp"

#include "child_scripts_python.hpp"
#include "python_call.hpp"

namespace bubblesim {
namespace {

namespace py = pybind11;

template <class Action>
void with_devices(Simulation& simulation, Action action) {
  scripting::with_python(simulation, "Gazebo plugins", action);
}

}  // namespace

struct GazeboPlugins::Python {
  py::object devices;
  py::object actuate;  // looked up once, called in every step
  py::object publish;
};

GazeboPlugins::GazeboPlugins(Simulation& simulation, const ChildScripts& scripts)
    : simulation_(simulation), python_(std::make_unique<Python>()) {
  with_devices(simulation, [&] {
    python_->devices = py::module_::import("bubblesim.gazebo_plugins.robots")
                           .attr("GazeboPlugins")(py::cast(&simulation, py::return_value_policy::reference),
                                                  scripts.python_->host.attr("bridge"));
    python_->actuate = python_->devices.attr("actuate");
    python_->publish = python_->devices.attr("publish");
  });
}

GazeboPlugins::~GazeboPlugins() {
  const py::gil_scoped_acquire gil;
  python_.reset();
}

void GazeboPlugins::actuate(World&, double) {
  with_devices(simulation_, [&] { python_->actuate(); });
}

void GazeboPlugins::publish(const World&, double) {
  with_devices(simulation_, [&] { python_->publish(); });
}

void GazeboPlugins::reset() {
  with_devices(simulation_, [&] { python_->devices.attr("reset")(); });
}

void GazeboPlugins::model_added(World&, ObjectId model) {
  with_devices(simulation_, [&] { python_->devices.attr("add_model")(model); });
}

void GazeboPlugins::model_removing(World&, ObjectId model) {
  with_devices(simulation_, [&] { python_->devices.attr("remove_model")(model); });
}

}  // namespace bubblesim
