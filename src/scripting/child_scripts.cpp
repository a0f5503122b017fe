// SPDX-License-Identifier: BSD-3-Clause
// Calls the Python object that runs the scripts in each phase of a step
// (bubblesim.scripting.host.host.ScriptHost).
#include "bubblesim/child_scripts.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdio>
#include <utility>

#include "bubblesim/error.hpp"
#include "child_scripts_python.hpp"
#include "python_call.hpp"

namespace bubblesim {
namespace {

namespace py = pybind11;

using ScriptFiles = std::vector<std::pair<std::string, std::filesystem::path>>;  // by object path

/// Returns the scripts of a model at `path` and of its nested models.
ScriptFiles scripts_of(const ModelDescription& model, const std::string& path) {
  ScriptFiles scripts;
  if (!model.child_script.empty()) scripts.emplace_back(path, model.child_script);
  for (const NestedModelDescription& nested : model.nested) {
    if (nested.child_script.empty()) continue;
    scripts.emplace_back(path + "/" + as_path(nested.name), nested.child_script);
  }
  return scripts;
}

/// Returns the scene's scripts, with the replacements applied.
ScriptFiles scripts_to_run(const Simulation& simulation, const ScriptOptions& options) {
  const SceneTree& tree = simulation.world().tree();
  ScriptFiles scripts;
  for (const ModelDescription& model : simulation.scene().models) {
    for (auto& script : scripts_of(model, "/" + model.name)) scripts.push_back(std::move(script));
  }
  for (const auto& [object, file] : options.replacements) {
    const std::string path = tree.path(tree.find(object));
    if (!std::filesystem::is_regular_file(file)) {
      throw InvalidInput("file not found: " + file.string() + " (child script of " + path + ")");
    }
    auto script = scripts.begin();
    while (script != scripts.end() && script->first != path) ++script;
    if (script == scripts.end()) script = scripts.insert(script, {path, {}});
    script->second = file;
  }
  return scripts;
}

template <class Action>
void with_python(Simulation& simulation, Action action) {
  scripting::with_python(simulation, "the script host", action);
}

}  // namespace

/// Like with_python(), and updates the number of failed scripts.
template <class Action>
void ChildScripts::with_host(Action action) {
  with_python(simulation_, [&] {
    action();
    failures_ = python_->host.attr("failures").cast<int>();
    disabled_ = python_->host.attr("disabled").cast<int>();
  });
}

ChildScripts::ChildScripts(Simulation& simulation, messages::Bridge* bridge, const ScriptOptions& options)
    : simulation_(simulation), python_(std::make_unique<Python>()) {
  with_python(simulation, [&] {
    const py::object host_class = py::module_::import("bubblesim.scripting.host.host").attr("ScriptHost");
    const py::object py_simulation = py::cast(&simulation, py::return_value_policy::reference);
    py::object py_bridge = py::none();
    if (bridge != nullptr) {
      py_bridge = py::cast(bridge, py::return_value_policy::reference);
      if (!options.record.empty() || !options.lockstep.empty()) {
        py_bridge = py::module_::import("bubblesim.observers.observed_bridge")
                        .attr("observed")(py_bridge, py_simulation, options.record.string(), options.lockstep);
      }
    }
    python_->host =
        host_class(py_simulation, py_bridge, scripts_to_run(simulation, options), options.search_paths,
                   py::arg("lua_unsafe") = options.lua_unsafe, py::arg("allowed_programs") = options.allowed_programs,
                   py::arg("watch") = options.watch);
    if (bridge != nullptr) {
      const py::object control = py::module_::import("bubblesim.services.offered")
                                     .attr("Control")(python_->host, py::arg("gazebo_compat") = options.gazebo_compat);
      python_->host.attr("after_input") = control.attr("process_input");
      python_->publish = control.attr("publish");
      python_->close = control.attr("close");
    }
    python_->host.attr("start")();
    // Look these up once: they are called in every step.
    python_->process_input = python_->host.attr("process_input");
    python_->actuate = python_->host.attr("actuate");
    python_->sense = python_->host.attr("sense");
    python_->finish = python_->host.attr("finish");
  });
  with_host([] {});
}

ChildScripts::~ChildScripts() {
  try {
    finish();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
  const py::gil_scoped_acquire gil;
  python_->actuate = python_->sense = python_->finish = python_->process_input = python_->publish = python_->close =
      python_->host = py::object();
}

/// Also runs without input: earlier messages may have made a script fail.
void ChildScripts::process_input() {
  with_host([&] { python_->process_input(); });
}

void ChildScripts::publish(const World&, double) {
  if (python_->publish) with_python(simulation_, [&] { python_->publish(); });
}

void ChildScripts::actuate(World&, double) {
  with_host([&] { python_->actuate(); });
}

void ChildScripts::sense(const World&, double) {
  with_host([&] { python_->sense(); });
}

void ChildScripts::stop() {
  with_host([&] { python_->host.attr("stop")(); });
}

void ChildScripts::start() {
  with_host([&] { python_->host.attr("start")(); });
}

void ChildScripts::reset() {
  with_host([&] { python_->host.attr("reset")(); });
}

void ChildScripts::model_added(World& world, ObjectId model) {
  for (const auto& [path, file] : scripts_of(world.description(model), world.tree().path(model))) {
    with_host([&, &path = path, &file = file] { python_->host.attr("add_script")(path, file); });
  }
}

void ChildScripts::model_removing(World&, ObjectId model) {
  with_host([&] { python_->host.attr("end_scripts_of")(model); });
}

void ChildScripts::finish() {
  if (std::exchange(python_->finished, true)) return;
  with_host([&] {
    python_->finish();
    if (python_->close) python_->close();
    output_lost_ = py::module_::import("bubblesim.scripting.language.script_output").attr("lost").cast<bool>();
  });
}

void interrupt_scripts() { scripting::interrupt(); }

}  // namespace bubblesim
