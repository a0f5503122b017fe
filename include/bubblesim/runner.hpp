// SPDX-License-Identifier: BSD-3-Clause
// Runs a simulation: paces its steps, and carries out the commands of other threads between them.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/frame.hpp"
#include "bubblesim/frame_memory.hpp"
#include "bubblesim/run_report.hpp"
#include "bubblesim/run_state.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// Holds back steps, for example until a controller has answered the last one. Called on the runner's thread, again
/// after each input.
struct StepGate {
  std::function<bool()> is_open;
  /// Why it is not open; for steps that were requested and waited too long.
  std::function<std::string()> why_closed;
};

using GateId = std::uint64_t;

struct WatchedDescriptor;

struct RunnerOptions {
  double speed = 1;  ///< simulated seconds per second; infinity: as fast as possible
  RunState initial = RunState::kPaused;
  /// s of simulation time at which run() returns.
  double until = std::numeric_limits<double>::infinity();
  /// A stop ends run(): world and time are not reset after the last step, and a divergence ends it, too.
  bool ends_at_stop = false;
  /// Polled at least 20 times a second; run() returns when it is true.
  std::function<bool()> is_ending;
  /// Called on the runner's thread with the reason when a divergence has paused the simulation.
  std::function<void(const std::string&)> on_divergence;
};

/// While run() or a thread of run_in_background() runs a simulation, other threads use it through this class only.
/// Its functions are thread-safe, except run(), run_in_background(), finish() and those for gates and
/// files.
///
/// Commands go to an inbox and are carried out between steps, in their order; they wake a runner that waits. The result
/// is ready when the command has been carried out; it is an exception (NotCarriedOut) when that is not possible, or
/// when the run ends before. A thread must not wait for a result in a function that the runner itself calls, such as a
/// System's. Commands of the time before run() are carried out at its start.
class Runner {
 public:
  /// The simulation must outlive the runner. Throws InvalidInput while another Runner runs it in the background.
  explicit Runner(Simulation& simulation, RunnerOptions options = {});
  /// Calls finish(), and loses its exception.
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  Simulation& simulation() { return simulation_; }
  const RunnerOptions& options() const { return options_; }

  /// Starts a stopped simulation from the start of the scene, or continues after a pause. The result of this and the
  /// next two is the state that follows. A command that does not fit the state, such as a pause of a stopped
  /// simulation, does nothing.
  std::future<RunState> start();
  std::future<RunState> pause();
  /// Runs one more step with the state kStopping, calls stop() of the systems, and resets world and time.
  std::future<RunState> stop();
  /// Runs `count` steps of a paused simulation, as fast as possible; input and other commands are processed between
  /// them. The result is the simulation time in s after the last step. Not carried out in other states, during another
  /// request for steps, after a divergence, and when a start, pause or stop comes before the last step.
  std::future<double> step(std::uint64_t count = 1);
  /// The same without an answer; functions that the runner calls between steps may call it.
  void request_steps(std::uint64_t count);
  /// Sets the simulated seconds per second; infinity: as fast as possible. Throws InvalidInput for other values.
  std::future<void> set_speed(double speed);
  double speed() const;
  /// In synchronous mode each step waits for one trigger. Early triggers are kept until a stop. step() does not need
  /// triggers.
  std::future<void> set_synchronous(bool synchronous);
  std::future<void> trigger_step();
  /// Ends run() after the current step.
  std::future<void> end();
  /// Calls a function between two steps, where it may use and change the simulation. The result is what it returns or
  /// throws.
  template <class Action>
  auto call(Action action) -> std::future<std::invoke_result_t<Action>> {
    using Result = std::invoke_result_t<Action>;
    const auto answer = std::make_shared<std::promise<Result>>();
    put([answer, action = std::move(action)](const Hook& before) mutable { fulfil(*answer, action, before); },
        [answer](const std::exception_ptr& why) { answer->set_exception(why); });
    return answer->get_future();
  }

  RunState state() const;
  /// Whether a thread is in run().
  bool is_running() const;
  /// Whether this thread is.
  bool is_this_thread() const;
  /// Whether a requested stop is pending.
  bool stop_is_due() const;
  /// Makes a runner that waits process the input of the systems: some has arrived.
  void wake();
  /// The state after the last step, or after the last input and commands of a pause. Does not wait for a step.
  std::shared_ptr<const Frame> frame() const;
  /// Memory in which other processes find each frame from now on. Throws std::logic_error in another thread while the
  /// runner runs. It lives as long as the runner.
  FrameMemory& share_frames();
  /// Statistics since the last call; what concerns scripts is left empty.
  RunReport take_report();
  /// Totals of all steps in one line: simulated seconds, real-time factor, steps.
  std::string summary();
  /// Puts a failure into the report.
  void report_failure(const std::string& why);

  /// A step waits until all gates are open. These and the next two throw std::logic_error in another thread while the
  /// runner runs. Do not call them in a function of a gate.
  GateId add_gate(StepGate gate);
  void remove_gate(GateId gate);
  void remove_gates();
  /// For DescriptorWatch, which see.
  void add_descriptor(std::shared_ptr<WatchedDescriptor> descriptor);
  void remove_descriptor(const WatchedDescriptor& descriptor);
  /// Runs the simulation on this thread until end(), the time limit, is_ending, or a stop that ends it. Throws what a
  /// step throws, except a divergence that a reset can mend.
  void run();
  /// The same on a thread of its own. Until finish(), the simulation refuses the other threads with std::logic_error.
  /// Throws InvalidInput when another Runner runs the simulation in the background, std::logic_error during a step.
  void run_in_background();
  /// Ends the thread of run_in_background() and waits for it; from here on, commands are refused until the next run.
  /// Throws what that thread's run() has thrown.
  void finish();

 private:
  struct Impl;

  using Hook = std::function<void()>;

  template <class Result, class Action>
  static void fulfil(std::promise<Result>& answer, Action& action, const Hook& before_answer) {
    try {
      if constexpr (std::is_void_v<Result>) {
        action();
        before_answer();
        answer.set_value();
      } else {
        Result result = action();
        before_answer();
        answer.set_value(std::move(result));
      }
    } catch (...) {
      answer.set_exception(std::current_exception());
    }
  }
  void put(std::function<void(const Hook& before_answer)> run, std::function<void(const std::exception_ptr&)> refuse);

  Simulation& simulation_;
  const RunnerOptions options_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace bubblesim
