// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/child_scripts.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "python_methods.hpp"

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

/// Adds the scripts of the parts of a model that have places of their own in the tree.
void add_placed(const World& world, ObjectId model, ScriptFiles& scripts) {
  const SceneTree& tree = world.tree();
  const ModelDescription& description = world.models().description(model);
  const auto add = [&](ObjectId id, const std::optional<TreePlace>& place) {
    if (place && !place->child_script.empty()) scripts.emplace_back(tree.path(id), place->child_script);
  };
  for (const ObjectId id : tree.parts(model, ObjectKind::kLink)) add(id, description.links[tree.at(id).index].place);
  for (const ObjectId id : tree.parts(model, ObjectKind::kJoint)) add(id, description.joints[tree.at(id).index].place);
  for (const ObjectId id : tree.parts(model, ObjectKind::kSensor)) add(id, world.models().sensor_description(id).place);
  for (const ObjectId id : tree.parts(model, ObjectKind::kFrame)) add(id, description.frames[tree.at(id).index].place);
}

/// Asks on the terminal, once for the content of a file: the answer is kept with its conversion, which is found by all
/// of its bytes. Without a terminal the answer is no.
bool allows_python(const ScriptFiles& scripts) {
  const auto script =
      std::find_if(scripts.begin(), scripts.end(), [](const auto& each) { return each.second.extension() == ".py"; });
  if (script == scripts.end()) return false;
  const std::filesystem::path answer = script->second.parent_path().parent_path() / "python_scripts_allowed";
  if (std::filesystem::exists(answer)) return true;
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDERR_FILENO) == 0) return false;
  std::fprintf(stderr,
               "This scene has Python scripts, which may do whatever you may. They are in %s: read them first.\n"
               "Run them, now and whenever this file is loaded? [y/N] ",
               script->second.parent_path().c_str());
  std::string line;
  if (!std::getline(std::cin, line) || (line != "y" && line != "Y" && line != "yes")) return false;
  std::ofstream(answer) << "yes\n";
  return true;
}

/// Says which programs a foreign scene starts. Those in Lua run in the sandbox; those in Python only if that is
/// allowed.
ScriptFiles trusted_of(const ScriptFiles& scripts, bool with_python) {
  ScriptFiles trusted;
  for (const auto& script : scripts) {
    const auto& [object, file] = script;
    const bool is_python = file.extension() == ".py";
    const char* note = !is_python    ? "Lua, in the sandbox"
                       : with_python ? "Python, which may do whatever you may"
                                     : "Python, not run: read it, then allow it with --allow-python-scripts";
    std::fprintf(stderr, "info: script of %s: %s (%s)\n", object.c_str(), file.c_str(), note);
    if (!is_python || with_python) trusted.push_back(script);
  }
  return trusted;
}

/// Returns the scene's scripts, with the replacements applied.
ScriptFiles scripts_to_run(const Simulation& simulation, const ScriptOptions& options) {
  const SceneTree& tree = simulation.world().tree();
  ScriptFiles scripts;
  for (const ModelDescription& model : simulation.scene().models) {
    for (auto& script : scripts_of(model, "/" + model.name)) scripts.push_back(std::move(script));
  }
  ScriptFiles included;  // with a model of another simulator
  for (const ObjectId model : tree.models()) {
    const bool is_included = simulation.world().models().description(model).is_foreign;
    add_placed(simulation.world(), model, is_included ? included : scripts);
  }
  const std::vector<FrameDescription>& frames = simulation.scene().frames;
  for (const ObjectId id : tree.objects()) {
    if (tree.at(id).kind != ObjectKind::kFrame || tree.outermost_model_of(id) != kNoObject) continue;
    const std::optional<TreePlace>& place = frames[tree.at(id).index].place;
    if (place && !place->child_script.empty()) scripts.emplace_back(tree.path(id), place->child_script);
  }
  if (is_foreign_scene(simulation.scene().file)) {
    scripts = trusted_of(scripts, options.python_of_foreign_scenes || allows_python(scripts));
  }
  for (auto& script : trusted_of(included, options.python_of_foreign_scenes)) scripts.push_back(std::move(script));
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

/// Folders for what scripts include. Those of a foreign scene are in the folder of its conversion, and expect their
/// files beside the scene.
std::vector<std::filesystem::path> search_paths_of(const Simulation& simulation, const ScriptOptions& options) {
  std::vector<std::filesystem::path> folders = options.search_paths;
  const std::filesystem::path& file = simulation.scene().file;
  if (is_foreign_scene(file)) folders.push_back(std::filesystem::absolute(file).parent_path());
  return folders;
}

}  // namespace

ChildScripts::ChildScripts(PythonEngine& engine, const ScriptOptions& options)
    : PythonSystem(engine, "the script host"), python_of_foreign_scenes_(options.python_of_foreign_scenes) {
  with_python([&] {
    const auto& [interpreter, runner, bridge] = engine.objects();
    const py::object host_class = py::module_::import("bubblesim.scripting.host.host").attr("ScriptHost");
    methods_->bind(
        host_class(runner, bridge, scripts_to_run(engine.runner().simulation(), options),
                   search_paths_of(engine.runner().simulation(), options), py::arg("lua_unsafe") = options.lua_unsafe,
                   py::arg("allowed_programs") = options.allowed_programs, py::arg("watch") = options.watch));
    if (engine.runner().state() != RunState::kStopped) methods_->start();
  });
}

ChildScripts::~ChildScripts() {
  try {
    finish();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
}

void ChildScripts::after_call() {
  // Interned once, for each call in each step makes these two.
  static const py::handle failures = PyUnicode_InternFromString("failures");
  static const py::handle disabled = PyUnicode_InternFromString("disabled");
  failures_ = methods_->self.attr(failures).cast<int>();
  disabled_ = methods_->self.attr(disabled).cast<int>();
}

void ChildScripts::model_added(World& world, ObjectId model) {
  ScriptFiles scripts = scripts_of(world.models().description(model), world.tree().path(model));
  add_placed(world, model, scripts);
  if (world.models().description(model).is_foreign) scripts = trusted_of(scripts, python_of_foreign_scenes_);
  for (const auto& [path, file] : scripts) {
    with_python([&, &path = path, &file = file] { methods_->self.attr("add_script")(path, file); });
  }
}

void ChildScripts::finish() {
  if (std::exchange(finished_, true)) return;
  with_python([&] {
    methods_->self.attr("finish")();
    output_lost_ = py::module_::import("bubblesim.scripting.language.script_output").attr("lost").cast<bool>();
  });
}

void interrupt_scripts() { scripting::interrupt(); }

}  // namespace bubblesim
