// SPDX-License-Identifier: BSD-3-Clause
// One object of a simulation, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/simulation.hpp"

namespace bubblesim::bindings {

/// Keeps the Python simulation alive as long as one of its objects is held.
class ObjectView {
 public:
  ObjectView(pybind11::object simulation, ObjectId id)
      : owner_(std::move(simulation)), simulation_(owner_.cast<Simulation*>()), id_(id) {}

  ObjectId id() const { return id_; }
  const pybind11::object& owner() const { return owner_; }
  Simulation& simulation() const { return *simulation_; }
  World& world() const { return simulation_->world(); }
  const SceneTree& tree() const { return simulation_->world().tree(); }
  const Object& object() const { return tree().at(id_); }

 private:
  pybind11::object owner_;
  Simulation* simulation_;
  ObjectId id_;
};

/// The last reading of a sensor as a Python object.
pybind11::object last_reading(Simulation& simulation, ObjectId sensor);

}  // namespace bubblesim::bindings
