// SPDX-License-Identifier: BSD-3-Clause
// What an editor of scenes needs: copies of models, and a spring that pulls a body.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "bubblesim/point_spring.hpp"
#include "devices/attached.hpp"
#include "guarded.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// The description of a model, which outlives the model.
struct ModelCopy {
  ModelDescription description;
};

std::unique_ptr<ModelCopy> copy_model(Simulation& simulation, ObjectId model) {
  const HoldWithGil hold(lock_of(simulation));
  const World& world = simulation.world();
  if (!world.tree().at(model).is_outermost_model()) {
    throw InvalidInput(world.tree().short_path(model) + " is not a top-level model");
  }
  auto copy = std::make_unique<ModelCopy>(ModelCopy{world.models().description(model)});
  copy->description.pose = world.pose(model);
  return copy;
}

ObjectId add_copy(Simulation& simulation, const ModelCopy& copy, const std::string& name, const NumpyArray& position,
                  const NumpyArray& orientation) {
  ModelDescription model = copy.description;
  model.name = name;
  model.pose = Pose(to_vector(position, "position"), to_quaternion(orientation, "orientation"));
  const py::gil_scoped_release others_may_run;
  return simulation.add_model(std::move(model));
}

/// A context of Python in which its thread stands in for the stepping one.
class StandInContext {
 public:
  explicit StandInContext(Simulation& simulation) : simulation_(simulation) {}
  void enter() { stand_in_.emplace(simulation_); }
  void leave() { stand_in_.reset(); }

 private:
  Simulation& simulation_;
  std::optional<Simulation::StandIn> stand_in_;
};

}  // namespace

void bind_editing(py::module_& module) {
  py::class_<ModelCopy>(module, "ModelCopy", "The description of a model, which outlives the model.")
      .def_property_readonly("name", [](const ModelCopy& copy) { return copy.description.name; })
      .def_property_readonly("position", [](const ModelCopy& copy) { return to_list(copy.description.pose.position); })
      .def_property_readonly("orientation", [](const ModelCopy& copy) {
        const Quaternion& turn = copy.description.pose.orientation;
        return std::array<double, 4>{turn.x(), turn.y(), turn.z(), turn.w()};
      });
  module.def("copy_model", &copy_model, py::arg("simulation"), py::arg("model"),
             "Return the description of a top-level model, with its present pose.");
  module.def("add_copy", &add_copy, py::arg("simulation"), py::arg("copy"), py::arg("name"), py::arg("position"),
             py::arg("orientation"), "Add a model by the description of another one; return its handle.");

  py::class_<StandInContext>(module, "StandIn",
                             "A context in which this thread may add and remove models like the stepping thread, which "
                             "waits for it.")
      .def(py::init<Simulation&>(), py::arg("simulation"), py::keep_alive<1, 2>())
      .def("__enter__", &StandInContext::enter)
      .def("__exit__", [](StandInContext& context, const py::args&) { context.leave(); });

  using Spring = Attached<PointSpring>;
  py::class_<Spring>(module, "PointSpring", "A spring that pulls a point of a link to a place in the world.")
      .def(py::init([](Simulation& simulation) {
             return attach(simulation.world(), std::make_shared<PointSpring>(), kNoObject, 0);
           }),
           py::arg("simulation"), py::keep_alive<1, 2>())
      .def("grip",
           [](Spring& spring, ObjectId link, const NumpyArray& point) {
             const HoldWithGil hold(lock_of(spring));
             spring.device->grip(spring.world, link, to_vector(point, "point"));
           })
      .def("pull_to",
           [](Spring& spring, const NumpyArray& target) {
             const HoldWithGil hold(lock_of(spring));
             spring.device->pull_to(to_vector(target, "target"));
           })
      .def("release",
           [](Spring& spring) {
             const HoldWithGil hold(lock_of(spring));
             spring.device->release();
           })
      .def("remove", &Spring::remove);
}

}  // namespace bubblesim::bindings
