// SPDX-License-Identifier: BSD-3-Clause
// The module bubblesim._plugin_devices: devices in libraries of the user, exported by pluginlib's macros.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <class_loader/class_loader.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/plugin_device.hpp"
#include "bubblesim/simulation.hpp"
#include "guarded.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

using Library = class_loader::ClassLoader;

/// A device of a library in a world. The library stays loaded as long as it.
class LoadedDevice {
 public:
  LoadedDevice(std::shared_ptr<Library> library, const std::string& class_name, Simulation& simulation, ObjectId model,
               ObjectId owner, const PluginDescription& plugin, std::string ros_namespace)
      : library_(std::move(library)), world_(simulation.world()) {
    const HoldWithGil hold(world_.access());
    const py::gil_scoped_release others_may_run;  // it may call a ROS master
    std::shared_ptr<PluginDevice> device = library_->createUniqueInstance<PluginDevice>(class_name);
    const PluginParameters parameters(plugin);
    load(*device, {world_, model, owner, parameters, std::move(ros_namespace)});
    names_read_.assign(parameters.names_read().begin(), parameters.names_read().end());
    switched_ = std::make_shared<SwitchedDevice>(std::move(device));
    world_.devices().add(switched_, model);
  }

  std::string failure() const {
    const HoldWithGil hold(world_.access());
    return switched_ ? switched_->failure() : "";
  }

  const std::vector<std::string>& names_read() const { return names_read_; }

  /// Destroys the device, when its model has gone, too.
  void remove() {
    if (!switched_) return;
    const HoldWithGil hold(world_.access());
    const py::gil_scoped_release others_may_run;  // its threads may end now
    world_.devices().remove(*switched_);
    switched_.reset();
  }

 private:
  static void load(PluginDevice& device, const PluginPlace& place) {
    try {
      device.load(place);
    } catch (const PluginParameterError&) {  // its text has the place
      throw;
    } catch (...) {  // the user may throw anything
      throw std::runtime_error("load(): " + text_of_handled_exception());
    }
  }

  std::shared_ptr<Library> library_;  // destroyed last
  World& world_;
  std::vector<std::string> names_read_;
  std::shared_ptr<SwitchedDevice> switched_;
};

std::shared_ptr<Library> open_library(const std::string& path) {
  const py::gil_scoped_release others_may_run;  // constructors of its variables run
  return std::make_shared<Library>(path);
}

}  // namespace

PYBIND11_MODULE(_plugin_devices, module) {
  module.doc() = "Devices in libraries of the user.";
  py::module_::import("bubblesim._core");  // has the classes of the arguments
  py::class_<Library, std::shared_ptr<Library>>(module, "Library", "A library that exports devices.")
      .def(py::init(&open_library), py::arg("path"), "Load it; raise RuntimeError if that is not possible.")
      .def(
          "classes", [](Library& library) { return library.getAvailableClasses<PluginDevice>(); },
          "Return the names of the classes in C++ that it exports.");
  py::class_<LoadedDevice>(module, "LoadedDevice", "A device that is called before each physics substep.")
      .def(py::init<std::shared_ptr<Library>, const std::string&, Simulation&, ObjectId, ObjectId,
                    const PluginDescription&, std::string>(),
           py::arg("library"), py::arg("class_name"), py::arg("simulation"), py::arg("model"), py::arg("owner"),
           py::arg("plugin"), py::arg("ros_namespace"), py::keep_alive<1, 4>(),
           "Make a device of a class and load it; raise what load() throws.")
      .def_property_readonly("failure", &LoadedDevice::failure, "What it threw since; empty when it works.")
      .def_property_readonly("names_read", &LoadedDevice::names_read, "The parameters that it read.")
      .def("remove", &LoadedDevice::remove, "Remove it from the world and destroy it.");
}

}  // namespace bubblesim::bindings
