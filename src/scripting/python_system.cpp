// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/python_system.hpp"

#include <stdexcept>
#include <utility>

#include "python_methods.hpp"

namespace bubblesim {

namespace py = pybind11;

PythonEngine::PythonEngine() : objects_(std::make_unique<Objects>()) {
  scripting::with_python(nullptr, "the simulator's Python code",
                         [] { py::module_::import("bubblesim._core"); });  // knows the classes
}

PythonEngine::~PythonEngine() { end(); }

void PythonEngine::begin(Runner& runner, const std::vector<messages::Bridge*>& bridges) {
  const py::gil_scoped_acquire gil;
  runner_ = &runner;
  objects_->runner = py::cast(&runner, py::return_value_policy::reference);
  const auto object_of = [](messages::Bridge* bridge) { return py::cast(bridge, py::return_value_policy::reference); };
  objects_->bridge = py::none();
  if (bridges.size() == 1) objects_->bridge = object_of(bridges[0]);
  if (bridges.size() == 2) {
    scripting::with_python(simulation(), "the simulator's Python code", [&] {
      objects_->bridge = py::module_::import("bubblesim.both_bridges")
                             .attr("BothBridges")(object_of(bridges[0]), object_of(bridges[1]));
    });
  }
}

void PythonEngine::end() {
  const py::gil_scoped_acquire gil;
  if (runner_ != nullptr) runner_->remove_gates();  // their functions may be Python's
  runner_ = nullptr;
  objects_->runner = objects_->bridge = py::object();
}

Runner& PythonEngine::runner() {
  if (runner_ == nullptr) throw std::logic_error("Python's systems have no runner");
  return *runner_;
}

Simulation* PythonEngine::simulation() { return runner_ != nullptr ? &runner_->simulation() : nullptr; }

void PythonSystem::Methods::bind(py::object object) {
  self = std::move(object);
  const auto method = [this](const char* name) { return py::getattr(self, name, py::object()); };
  process_input = method("process_input");
  actuate = method("actuate");
  sense = method("sense");
  publish = method("publish");
  stop = method("stop");
  start = method("start");
  reset = method("reset");
  model_added = method("model_added");
  model_removing = method("model_removing");
  save_state = method("save_state");
  restore_state = method("restore_state");
}

PythonSystem::PythonSystem(PythonEngine& engine, std::string name)
    : engine_(engine), name_(std::move(name)), methods_(std::make_unique<Methods>()) {}

PythonSystem::~PythonSystem() {
  const py::gil_scoped_acquire gil;
  methods_.reset();
}

void PythonSystem::process_input() {
  if (methods_->process_input) with_python([&] { methods_->process_input(); });
}

void PythonSystem::actuate(World&, double) {
  if (methods_->actuate) with_python([&] { methods_->actuate(); });
}

void PythonSystem::sense(const World&, double) {
  if (methods_->sense) with_python([&] { methods_->sense(); });
}

void PythonSystem::publish(const World&, double) {
  if (methods_->publish) with_python([&] { methods_->publish(); });
}

void PythonSystem::stop() {
  if (methods_->stop) with_python([&] { methods_->stop(); });
}

void PythonSystem::start() {
  if (methods_->start) with_python([&] { methods_->start(); });
}

void PythonSystem::reset() {
  if (methods_->reset) with_python([&] { methods_->reset(); });
}

void PythonSystem::model_added(World&, ObjectId model) {
  if (methods_->model_added) with_python([&] { methods_->model_added(model); });
}

void PythonSystem::model_removing(World&, ObjectId model) {
  if (methods_->model_removing) with_python([&] { methods_->model_removing(model); });
}

std::string PythonSystem::state_name() const { return methods_->save_state ? name_ : ""; }

std::string PythonSystem::save_state() {
  std::string state;
  with_python([&] { state = methods_->save_state().cast<std::string>(); });
  return state;
}

void PythonSystem::restore_state(std::string_view state) {
  with_python([&] { methods_->restore_state(py::bytes(state.data(), state.size())); });
}

}  // namespace bubblesim
