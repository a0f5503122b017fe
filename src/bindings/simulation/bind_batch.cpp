// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Batch: many simulations of one scene.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/batch.hpp"
#include "bubblesim/error.hpp"
#include "scene/loaded_scene.hpp"
#include "simulation/random_quantities.hpp"
#include "step_count.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

using SceneOrName = std::variant<std::shared_ptr<Scene>, std::string>;
using States = std::variant<py::bytes, std::vector<py::bytes>>;
using Marks = py::array_t<bool, py::array::c_style | py::array::forcecast>;
using Seeds = py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast>;

/// A batch, and the buffer of its observations.
class PythonBatch {
 public:
  PythonBatch(std::shared_ptr<const Scene> scene, const BatchOptions& options)
      : type_(options.numbers == NumberType::kFloat32 ? py::dtype::of<float>() : py::dtype::of<double>()) {
    {
      const py::gil_scoped_release others_may_run;
      batch_ = std::make_unique<Batch>(std::move(scene), options);
    }
    observed_ = py::array(
        type_, std::vector<py::ssize_t>{py::ssize_t(batch_->size()), py::ssize_t(batch_->observations().width())});
    observe();
  }

  Batch& batch() { return *batch_; }
  const py::array& observed() const { return observed_; }
  const py::dtype& type() const { return type_; }

  py::array step(const std::optional<py::array>& actions, StepCount steps) {
    py::array row_major;
    const void* commands = nullptr;
    if (actions) {
      row_major = py::array::ensure(actions->attr("astype")(type_, py::arg("copy") = false), py::array::c_style);
      check_shape(row_major);
      commands = row_major.data();
    }
    void* out = observed_.mutable_data();
    {
      const py::gil_scoped_release others_may_run;
      batch_->step(commands, steps.value, out);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return observed_;
  }

  py::array observe() {
    void* out = observed_.mutable_data();
    const py::gil_scoped_release others_may_run;
    batch_->observe(out);
    return observed_;
  }

  py::array reset(const std::optional<Marks>& mask, const std::optional<Seeds>& seeds,
                  const std::optional<States>& states) {
    std::vector<std::uint8_t> marks;
    if (mask) marks.assign(mask->data(), mask->data() + mask->size());
    std::vector<std::uint64_t> numbers;
    if (seeds) numbers.assign(seeds->data(), seeds->data() + seeds->size());
    std::vector<std::string_view> bytes;
    if (states && states->index() == 0) bytes.emplace_back(std::get<0>(*states));
    if (states && states->index() == 1) {
      for (const py::bytes& state : std::get<1>(*states)) bytes.emplace_back(state);
      if (bytes.size() != batch_->size()) {
        throw InvalidInput("state: expected bytes for all worlds, or one for each of the " +
                           std::to_string(batch_->size()) + " worlds");
      }
    }
    {
      const py::gil_scoped_release others_may_run;
      batch_->reset(marks, numbers, bytes);
    }
    return observe();
  }

 private:
  void check_shape(const py::array& actions) const {
    const auto rows = static_cast<py::ssize_t>(batch_->size());
    const auto width = static_cast<py::ssize_t>(batch_->actions().width());
    if (actions.ndim() == 2 && actions.shape(0) == rows && actions.shape(1) == width) return;
    throw InvalidInput("actions: expected an array of " + std::to_string(rows) + " x " + std::to_string(width) +
                       " numbers, one row for each world");
  }

  std::unique_ptr<Batch> batch_;
  py::dtype type_;
  py::array observed_;
};

std::unique_ptr<PythonBatch> make_batch(const SceneOrName& scene, std::size_t worlds, std::uint64_t seed,
                                        const std::optional<std::size_t>& threads, std::vector<std::string> actions,
                                        std::vector<std::string> observations, const std::string& dtype,
                                        const Distributions& randomize) {
  BatchOptions options;
  options.worlds = worlds;
  options.seed = seed;
  if (threads && *threads == 0) throw InvalidInput("threads must be 1 or more, or None");
  options.threads = threads.value_or(0);
  options.actions = std::move(actions);
  options.observations = std::move(observations);
  options.randomized = to_random_quantities(randomize);
  if (dtype != "float32" && dtype != "float64") {
    throw InvalidInput("dtype '" + dtype + "' is not usable: it must be 'float32' or 'float64'");
  }
  options.numbers = dtype == "float32" ? NumberType::kFloat32 : NumberType::kFloat64;
  std::shared_ptr<const Scene> loaded;
  if (const auto* name = std::get_if<std::string>(&scene)) {
    loaded = loaded_scene(*name, {});
  } else {
    loaded = std::get<0>(scene);
  }
  return std::make_unique<PythonBatch>(std::move(loaded), options);
}

py::tuple shape_of(const Quantity& quantity) {
  py::tuple shape(quantity.shape.size());
  for (std::size_t i = 0; i < quantity.shape.size(); ++i) shape[i] = quantity.shape[i];
  return shape;
}

Simulation& world_at(PythonBatch& self, py::ssize_t i) {
  const auto count = static_cast<py::ssize_t>(self.batch().size());
  if (i < 0) i += count;
  if (i < 0 || i >= count) throw py::index_error("the batch has " + std::to_string(count) + " worlds");
  return self.batch()[static_cast<std::size_t>(i)];
}

}  // namespace

void bind_batch(py::module_& module) {
  py::class_<Quantity>(module, "Quantity", "Numbers of a named quantity in the rows of a batch.")
      .def_readonly("name", &Quantity::name, "Such as /Tricycle.pose.")
      .def_property_readonly("shape", &shape_of, "Of its numbers in a world.")
      .def_readonly("start", &Quantity::start, "Column of its first number.")
      .def_readonly("size", &Quantity::size, "Number of columns.")
      .def_property_readonly(
          "columns",
          [](const Quantity& q) { return py::slice(py::ssize_t(q.start), py::ssize_t(q.start + q.size), 1); },
          "The slice of its columns.")
      .def("__repr__", [](const Quantity& q) { return "<bubblesim.Quantity " + q.name + ">"; });

  py::class_<PythonBatch>(module, "Batch",
                          R"(Many simulations of one scene, stepped together by threads without the GIL.

World i equals, bit by bit, `Simulation(scene, seed=seed + i)` that gets the same commands, whatever the number of
worlds and threads.

:param scene: scene name, path of an .sdf file, or a Scene.
:param worlds: number of simulations.
:param seed: random seed of world 0; world i has `seed + i`.
:param threads: None: as many as the process may use cores.
:param actions: what `step` sets: quantities such as "/FrontMotor.target_velocity".
:param observations: what `step` returns: quantities such as "/Tricycle.pose", "/Goal.position@/Tricycle" (relative to
    another object), "/Lidar.ranges", "time". A path with * stands for all objects that have the quantity.
:param dtype: "float32" or "float64", of actions and observations.
:param randomize: Distributions by quantity, such as {"/Tricycle.mass": Distribution.uniform(8, 12)}, drawn for each
    world at the start and after resets, by its seed alone; see `Simulation.randomize`.
:raises ValueError: if the scene does not have a quantity; lists those that there are.)")
      .def(py::init(&make_batch), py::arg("scene").none(false), py::arg("worlds"), py::kw_only(), py::arg("seed") = 0,
           py::arg("threads") = py::none(), py::arg("actions") = std::vector<std::string>(),
           py::arg("observations") = std::vector<std::string>(), py::arg("dtype") = "float32",
           py::arg("randomize") = Distributions())
      .def("__len__", [](PythonBatch& b) { return b.batch().size(); })
      .def("__getitem__", &world_at, py::arg("world"), py::return_value_policy::reference_internal,
           "A world as a Simulation, to look into. It must not be used while the batch runs.")
      .def_property_readonly("threads", [](PythonBatch& b) { return b.batch().threads(); })
      .def_property_readonly("dtype", &PythonBatch::type)
      .def_property_readonly(
          "actions", [](PythonBatch& b) { return b.batch().actions().list(); },
          "The Quantities of a row of actions, in order.")
      .def_property_readonly(
          "observations", [](PythonBatch& b) { return b.batch().observations().list(); },
          "The Quantities of a row of observations, in order.")
      .def_property_readonly("observed", &PythonBatch::observed,
                             "The buffer of the last observations, worlds x columns, C-contiguous. It is written by\n"
                             "`step`, `reset` and `observe`: copy it to keep it.")
      .def_property_readonly(
          "failed",
          [](PythonBatch& b) {
            const std::vector<std::uint8_t>& failed = b.batch().failed();
            py::array_t<bool> marks(static_cast<py::ssize_t>(failed.size()));
            std::copy(failed.begin(), failed.end(), marks.mutable_data());
            return marks;
          },
          "For each world, whether it diverged or lost a model in the last `step`, and was reset.")
      .def("step", &PythonBatch::step, py::arg("actions") = py::none(), py::arg("steps") = 1,
           R"(Set the actions, run all worlds and return `observed`.

:param actions: worlds x columns; None: the commands stay as they are.
:param steps: simulation steps, in each of which the actions act.
:raises ValueError: if an action cannot be used.)")
      .def("observe", &PythonBatch::observe, "Write the observations of the present state to `observed` and return it.")
      .def("reset", &PythonBatch::reset, py::arg("mask") = py::none(), py::arg("seeds") = py::none(),
           py::arg("state") = py::none(),
           R"(Reset worlds and return `observed`.

:param mask: bool for each world; None: all.
:param seeds: seed for each world (those of other worlds are ignored); None: as before, or that of the state.
:param state: bytes of `Simulation.save` for all worlds, or a list of them for each world; None: the start.)");
}

}  // namespace bubblesim::bindings
