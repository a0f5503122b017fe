// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Runner: a simulation that runs in the background, its commands and its frames.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <chrono>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "bubblesim/descriptor_watch.hpp"
#include "bubblesim/runner.hpp"
#include "guarded.hpp"
#include "step_count.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// Waits without the GIL, and checks Python's signals so that Ctrl-C ends the wait.
template <class Result>
Result wait_for(std::future<Result> result) {
  constexpr std::chrono::milliseconds kBetweenSignals{50};
  for (;;) {
    {
      const py::gil_scoped_release others_may_run;
      if (result.wait_for(kBetweenSignals) == std::future_status::ready) break;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return result.get();
}

void check_can_wait(const Runner& runner) {
  if (runner.is_this_thread()) throw std::logic_error("a function that the runner calls cannot wait for the runner");
  if (!runner.is_running()) {
    throw std::logic_error("the runner does not run: use it in a 'with' statement");
  }
}

template <class Result>
auto command(std::future<Result> (Runner::*request)()) {
  return [request](Runner& runner, bool wait) {
    if (wait) check_can_wait(runner);
    std::future<Result> result = (runner.*request)();
    if (wait) wait_for(std::move(result));
  };
}

void set_synchronous(Runner& runner, bool synchronous, bool wait) {
  if (wait) check_can_wait(runner);
  std::future<void> result = runner.set_synchronous(synchronous);
  if (wait) wait_for(std::move(result));
}

std::optional<double> step_runner(Runner& runner, StepCount steps, bool wait) {
  if (!wait) {
    runner.request_steps(steps.value);
    return std::nullopt;
  }
  check_can_wait(runner);
  return wait_for(runner.step(steps.value));
}

void set_speed(Runner& runner, double speed, bool wait) {
  if (wait) check_can_wait(runner);
  std::future<void> result = runner.set_speed(speed);
  if (wait) wait_for(std::move(result));
}

/// What a Python function returned or raised in the runner's thread; made and destroyed with the GIL.
struct Outcome {
  py::object value;
  std::optional<py::error_already_set> error;
};

py::object call_and_wait(const py::object& self, py::function function) {
  auto& runner = self.cast<Runner&>();
  check_can_wait(runner);
  auto outcome = std::make_unique<Outcome>();
  const py::object simulation = py::cast(&runner.simulation(), py::return_value_policy::reference_internal, self);
  auto action = [&function, &simulation, to = outcome.get()] {
    const py::gil_scoped_acquire gil;
    try {
      to->value = function(simulation);
    } catch (py::error_already_set& error) {
      to->error.emplace(error);
    }
  };
  std::future<void> done = runner.call(action);
  {
    // Not ended by Ctrl-C: the runner uses this function's variables.
    const py::gil_scoped_release others_may_run;
    done.wait();
  }
  done.get();
  if (outcome->error) throw py::error_already_set(*outcome->error);
  return outcome->value;
}

/// Ends a runner that still runs without the GIL, for which the functions of its thread may wait.
struct EndWithoutGil {
  void operator()(Runner* runner) const {
    const py::gil_scoped_release others_may_run;
    std::default_delete<Runner>()(runner);
  }
};
using RunnerPtr = std::unique_ptr<Runner, EndWithoutGil>;

RunnerPtr make_runner(Simulation& simulation, double speed) {
  RunnerOptions options;
  options.speed = speed;
  simulation.world().access().check_can_be_claimed();
  const HoldWithGil hold(simulation.world().access());
  return RunnerPtr(std::make_unique<Runner>(simulation, std::move(options)).release());
}

/// Makes a Python function callable without the GIL; destroyed with the GIL, wherever the last copy is.
template <class Result>
std::function<Result()> with_gil(py::function function) {
  const std::shared_ptr<py::function> held(new py::function(std::move(function)), [](py::function* last) {
    const py::gil_scoped_acquire gil;
    delete last;  // NOLINT(cppcoreguidelines-owning-memory): the deleter of a shared_ptr
  });
  return [held] {
    const py::gil_scoped_acquire gil;
    return (*held)().template cast<Result>();
  };
}

GateId add_gate(Runner& runner, py::function is_open, py::function why_closed) {
  return runner.add_gate({with_gil<bool>(std::move(is_open)), with_gil<std::string>(std::move(why_closed))});
}

void post(Runner& runner, py::function function) {
  auto action = with_gil<py::object>(std::move(function));
  runner.call([action = std::move(action)] {
    const py::gil_scoped_acquire gil;  // for the result, too
    try {
      action();
    } catch (py::error_already_set& error) {
      error.discard_as_unraisable("a function that was posted to a runner");
    }
  });
}

std::unique_ptr<DescriptorWatch> watch(Runner& runner, int descriptor, py::function serve) {
  return std::make_unique<DescriptorWatch>(runner, descriptor, with_gil<bool>(std::move(serve)));
}

using FramePtr = std::shared_ptr<const Frame>;

/// A read-only view into a frame, which it keeps alive.
template <class Number>
py::array_t<Number> view(const py::object& frame, const Number* data, std::vector<py::ssize_t> shape) {
  py::array_t<Number> array(std::move(shape), data, frame);
  array.attr("flags").attr("writeable") = false;
  return array;
}

py::array_t<float> poses(const py::object& self) {
  const Frame& frame = self.cast<const Frame&>();
  const auto* first = reinterpret_cast<const float*>(frame.poses.data());
  return view(self, first, {static_cast<py::ssize_t>(frame.poses.size()), 7});
}

py::array_t<float> joint_positions(const py::object& self) {
  const Frame& frame = self.cast<const Frame&>();
  return view(self, frame.joint_positions.data(), {static_cast<py::ssize_t>(frame.joint_positions.size())});
}

std::vector<std::pair<ObjectId, int>> axes(const Frame& frame) {
  std::vector<std::pair<ObjectId, int>> axes;
  for (const auto& [joint, axis] : frame.layout->axes) axes.emplace_back(joint, axis);
  return axes;
}

}  // namespace

void bind_runner(py::module_& module) {
  py::enum_<RunState>(module, "RunState", "Run state of a simulation.")
      .value("STOPPED", RunState::kStopped)
      .value("PAUSED", RunState::kPaused)
      .value("RUNNING", RunState::kRunning)
      .value("STOPPING", RunState::kStopping, "In the last step.");

  // pybind11 holds non-const pointers; nothing here changes a frame.
  py::class_<Frame, std::shared_ptr<Frame>>(module, "Frame", "A copy of what a simulation looks like at one time.")
      .def_readonly("time", &Frame::time, "Simulation time in seconds.")
      .def_readonly("state", &Frame::state)
      .def_property_readonly(
          "revision", [](const Frame& frame) { return frame.layout->revision; },
          "Another number after models were added or removed.")
      .def_property_readonly(
          "links", [](const Frame& frame) { return frame.layout->links; },
          "Handles of the links of `poses`: those of models that are not static.")
      .def_property_readonly("axes", &axes, "Pairs of joint handle and axis of `joint_positions`.")
      .def_property_readonly("poses", &poses,
                             "n x 7 float32: x, y, z in m and the quaternion x, y, z, w of each link in the world.")
      .def_property_readonly("joint_positions", &joint_positions, "float32, rad or m.");

  py::class_<DescriptorWatch>(module, "DescriptorWatch",
                              "Calls a function of a runner when a file descriptor is readable.")
      .def("close", &DescriptorWatch::close, py::call_guard<py::gil_scoped_release>(),
           "End it; after that the function is not called any more.")
      .def("serve_again", &DescriptorWatch::serve_again,
           "Have the function called even if the descriptor is not readable: for edge-triggered descriptors.");

  py::class_<Runner, RunnerPtr>(module, "Runner", R"(Runs a simulation on a thread of its own.

>>> with bubblesim.Runner(bubblesim.Simulation("tricycle")) as runner:
...     runner.step(20)
...     runner.call(lambda simulation: simulation.object("/Tricycle").position)
...     runner.start()

It begins paused. Its functions may be called in any thread; until the end of the `with` statement the simulation
itself refuses other threads. Commands are carried out between steps, in their order.

:param simulation: the Simulation.
:param speed: simulated seconds per second; math.inf is as fast as possible.
:raises ValueError: if the speed is not above 0, or another Runner runs the simulation: also in `__enter__`.)")
      .def(py::init(&make_runner), py::arg("simulation"), py::kw_only(), py::arg("speed") = 1.0, py::keep_alive<1, 2>())
      .def("__enter__",
           [](const py::object& self) {
             auto& runner = self.cast<Runner&>();
             {
               const py::gil_scoped_release others_may_run;
               runner.run_in_background();
             }
             return self;
           })
      .def(
          "__exit__", [](Runner& runner, const py::args&) { runner.finish(); },
          py::call_guard<py::gil_scoped_release>())
      .def("start", command(&Runner::start), py::kw_only(), py::arg("wait") = true,
           "Start from the start of the scene, or continue after a pause. With `wait`, return when it is done.")
      .def("pause", command(&Runner::pause), py::kw_only(), py::arg("wait") = true, "Pause between two steps.")
      .def("stop", command(&Runner::stop), py::kw_only(), py::arg("wait") = true,
           "Run one more step, and go back to the start of the scene.")
      .def("end", command(&Runner::end), py::kw_only(), py::arg("wait") = true, "End the run.")
      .def("set_synchronous", &set_synchronous, py::arg("synchronous"), py::kw_only(), py::arg("wait") = true,
           "Run one step per trigger_step(), and no others.")
      .def("trigger_step", command(&Runner::trigger_step), py::kw_only(), py::arg("wait") = true)
      .def("step", &step_runner, py::arg("steps") = 1, py::kw_only(), py::arg("wait") = true,
           "Run steps of a paused simulation as fast as possible; return the simulation time in seconds, or None\n"
           "without `wait`.\n\n"
           ":raises NotCarriedOut: if it is not paused, diverges, or is started, paused or stopped before the last "
           "step.")
      .def("call", &call_and_wait, py::arg("function"),
           "Call `function(simulation)` between two steps, and return what it returns.")
      .def("post", &post, py::arg("function"),
           "Call `function()` between two steps, after the commands so far, without waiting for it.")
      .def("set_speed", &set_speed, py::arg("speed"), py::kw_only(), py::arg("wait") = true,
           "Set the simulated seconds per second; math.inf is as fast as possible.")
      .def("add_gate", &add_gate, py::arg("is_open"), py::arg("why_closed"),
           "Make each step wait until `is_open()` is true; `why_closed()` returns the reason of a timeout. Return a\n"
           "number for `remove_gate`.\n\n"
           ":raises RuntimeError: in another thread than the runner's while it runs; `remove_gate`, too.")
      .def("remove_gate", &Runner::remove_gate, py::arg("gate"))
      .def(
          "watch", &watch, py::arg("descriptor"), py::arg("serve"), py::keep_alive<0, 1>(),
          "Call `serve()` between two steps when a file descriptor is readable, and again as long as it returns true.\n"
          "Return an object whose close() ends this.\n\n"
          ":raises RuntimeError: in another thread than the runner's while it runs; close(), too.")
      .def("share_frames", &Runner::share_frames, py::return_value_policy::reference_internal,
           "Return the FrameMemory in which other processes find the frames from now on.\n\n"
           ":raises RuntimeError: in another thread than the runner's while it runs.")
      .def_property_readonly(
          "simulation", [](Runner& runner) -> Simulation& { return runner.simulation(); },
          py::return_value_policy::reference_internal)
      .def_property_readonly("state", &Runner::state, "The RunState.")
      .def_property_readonly("speed", &Runner::speed, "Simulated seconds per second; math.inf is as fast as possible.")
      .def_property_readonly("stop_is_due", &Runner::stop_is_due, "Whether a requested stop is pending.")
      .def_property_readonly(
          "frame", [](const Runner& runner) { return std::const_pointer_cast<Frame>(runner.frame()); },
          "The last Frame; does not wait for a step.");
}

}  // namespace bubblesim::bindings
