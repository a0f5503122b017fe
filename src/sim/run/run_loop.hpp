// SPDX-License-Identifier: BSD-3-Clause
// The loop that runs a simulation. All functions are for the thread that runs it, except where stated.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "bubblesim/frame.hpp"
#include "bubblesim/frame_memory.hpp"
#include "bubblesim/runner.hpp"
#include "run/descriptors.hpp"
#include "run/inbox.hpp"
#include "run/pacer.hpp"
#include "run/run_meter.hpp"
#include "run/step_order.hpp"

namespace bubblesim {

class RunLoop {
 public:
  RunLoop(Simulation& simulation, const RunnerOptions& options);

  /// See Runner::run().
  void run();
  /// Refuses what is asked for, from here on.
  void close();
  GateId add_gate(StepGate gate);
  void remove_gate(GateId gate) { gates_.erase(gate); }
  void remove_gates() { gates_.clear(); }
  FrameMemory& share_frames();
  void set_speed(double speed);
  Descriptors& descriptors() { return descriptors_; }

  // What commands do:
  RunState start();
  RunState pause();
  RunState stop();
  void step(std::uint64_t count, const StepOrder::Answer& answer);
  void set_synchronous(bool synchronous);
  void trigger_step();
  void end() { ending_ = true; }

  // Thread-safe:
  Inbox& inbox() { return inbox_; }
  RunMeter& meter() { return meter_; }
  RunState state() const { return state_; }
  double speed() const { return speed_; }
  std::shared_ptr<const Frame> frame() const { return std::atomic_load(&frame_); }

 private:
  bool ends() const;
  void carry_out_commands();
  bool may_step() const;
  bool step_is_due() const;
  const StepGate* closed_gate() const;
  void wait_for_input();
  Descriptors::Event wait_until(Inbox::Clock::time_point end, Inbox::WaitFor what);
  bool wait_for_time();
  void run_step();
  void publish_frame();

  Simulation& simulation_;
  const RunnerOptions& options_;
  Inbox inbox_;
  std::atomic<double> speed_;  // that of pacer_, for other threads
  Descriptors descriptors_;
  Pacer pacer_;
  RunMeter meter_;
  std::map<GateId, StepGate> gates_;
  GateId next_gate_ = 0;
  StepOrder order_;
  std::atomic<RunState> state_;
  bool ending_ = false;
  bool synchronous_ = false;
  std::uint64_t triggers_ = 0;           // not used yet
  std::unique_ptr<FrameMemory> memory_;  // null until somebody wants it
  std::shared_ptr<const Frame> frame_;   // swapped as a whole, with std::atomic_store
};

}  // namespace bubblesim
