// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_loop.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "bubblesim/error.hpp"

namespace bubblesim {
namespace {

using Clock = Inbox::Clock;

constexpr std::chrono::milliseconds kIdlePeriod{20};   // longest wait for input
constexpr std::chrono::milliseconds kLongestWait{50};  // between two polls of input and signals while pacing
constexpr std::chrono::seconds kGateTimeout{5};        // for a step of a request

FramePose to_frame(const Pose& pose) {
  const auto number = [](double value) { return static_cast<float>(value); };
  return {number(pose.position.x()),    number(pose.position.y()),    number(pose.position.z()),
          number(pose.orientation.x()), number(pose.orientation.y()), number(pose.orientation.z()),
          number(pose.orientation.w())};
}

}  // namespace

RunLoop::RunLoop(Simulation& simulation, const RunnerOptions& options)
    : simulation_(simulation),
      options_(options),
      speed_(options.speed),
      pacer_(options.speed),
      meter_(options.speed),
      state_(options.initial) {
  meter_.note(simulation_, state_, false);
  publish_frame();
}

void RunLoop::run() {
  ending_ = false;
  while (!ends()) {
    carry_out_commands();
    descriptors_.serve_without_wait();
    meter_.note(simulation_, state_, may_step());
    if (ending_) break;
    if (state_ != RunState::kRunning) pacer_.restart();
    if (!step_is_due()) {
      wait_for_input();
    } else if (order_ || wait_for_time()) {
      run_step();
    } else {
      simulation_.process_input();  // also in a slow simulation
    }
  }
}

void RunLoop::close() {
  order_.fail("the simulation has ended");
  inbox_.close();
}

bool RunLoop::ends() const {
  if (ending_ || (options_.is_ending && options_.is_ending())) return true;
  // The tolerance keeps rounding from adding a step.
  return simulation_.time() > options_.until - 1e-6 * simulation_.time_step();
}

void RunLoop::carry_out_commands() {
  // Only the commands so far: scripts that keep starting and stopping the simulation must not keep this loop busy.
  const std::vector<Command> commands = inbox_.take();
  for (const Command& command : commands) {
    if (ending_) {
      command.refuse(Inbox::has_ended());
      continue;
    }
    if (command.kind != Command::Kind::kOther) order_.interrupt();
    command.run([this] {
      if (state_ != RunState::kRunning) publish_frame();  // who waited for the answer finds what it did
    });
  }
}

/// Whether the simulation may run by itself.
bool RunLoop::may_step() const { return state_ == RunState::kRunning && (!synchronous_ || triggers_ > 0); }

bool RunLoop::step_is_due() const { return (order_ || may_step()) && closed_gate() == nullptr; }

GateId RunLoop::add_gate(StepGate gate) {
  gates_.emplace(next_gate_, std::move(gate));
  return next_gate_++;
}

/// The first gate that is not open; null if all are.
const StepGate* RunLoop::closed_gate() const {
  for (const auto& [id, gate] : gates_) {
    if (!gate.is_open()) return &gate;
  }
  return nullptr;
}

void RunLoop::wait_for_input() {
  simulation_.process_input();
  publish_frame();
  if (step_is_due()) return;
  if (order_.has_waited(kGateTimeout)) {
    if (const StepGate* closed = closed_gate()) order_.fail(closed->why_closed());
  }
  const Clock::time_point end = Clock::now() + kIdlePeriod;
  while (wait_until(end, Inbox::WaitFor::kInput) == Descriptors::Event::kReadable) {
    descriptors_.serve();
    publish_frame();
    if (step_is_due() || Clock::now() >= end) return;
  }
}

Descriptors::Event RunLoop::wait_until(Clock::time_point end, Inbox::WaitFor what) {
  const AccessLock::Pause others_may_use_it(simulation_.world().access());
  return descriptors_.wait(inbox_, what, end);
}

/// Waits until the next step is due in real time. Returns false when something else is to be done first.
bool RunLoop::wait_for_time() {
  Clock::time_point now = Clock::now();
  const Clock::time_point longest = now + kLongestWait;
  for (;;) {
    const Clock::time_point due = pacer_.due(simulation_.time(), now);
    if (due <= now) return true;
    if (longest <= now) return false;
    if (wait_until(std::min(due, longest), Inbox::WaitFor::kCommands) == Descriptors::Event::kInbox) return false;
    descriptors_.serve();
    if (!step_is_due()) return false;
    now = Clock::now();
  }
}

void RunLoop::run_step() {
  if (triggers_ > 0 && !order_) --triggers_;
  try {
    meter_.run_step(simulation_);
  } catch (const Diverged& divergence) {
    if (options_.ends_at_stop) throw;  // nothing can reset it
    if (state_ == RunState::kRunning) state_ = RunState::kPaused;
    meter_.fail(divergence.what());
    if (order_) {
      order_.fail(divergence.what());
    } else if (options_.on_divergence) {
      options_.on_divergence(divergence.what());
    }
    return;
  }
  publish_frame();
  if (order_) order_.step_done(simulation_.time());
}

void RunLoop::publish_frame() {
  const World& world = simulation_.world();
  const std::shared_ptr<const Frame> last = frame();
  auto next = std::make_shared<Frame>();
  next->time = simulation_.time();
  next->state = state_;
  next->layout = last && last->layout->revision == world.revision()
                     ? last->layout
                     : std::make_shared<const FrameLayout>(frame_layout(world));
  next->poses.reserve(next->layout->links.size());
  for (const ObjectId link : next->layout->links) next->poses.push_back(to_frame(world.pose(link)));
  next->joint_positions.reserve(next->layout->axes.size());
  for (const auto& [joint, axis] : next->layout->axes) {
    next->joint_positions.push_back(static_cast<float>(world.joints().position(joint, axis)));
  }
  if (memory_) memory_->write(*next);
  std::atomic_store(&frame_, std::shared_ptr<const Frame>(std::move(next)));
}

void RunLoop::set_speed(double speed) {
  speed_ = speed;
  pacer_.set_speed(speed);
  meter_.set_wanted_speed(speed);
}

FrameMemory& RunLoop::share_frames() {
  if (!memory_) {
    memory_ = std::make_unique<FrameMemory>();
    memory_->write(*frame());
  }
  return *memory_;
}

// Commands

RunState RunLoop::start() {
  const RunState before = state_;
  state_ = RunState::kRunning;
  if (before == RunState::kStopped) simulation_.start_systems();
  return state_;
}

RunState RunLoop::pause() {
  if (state_ == RunState::kRunning) state_ = RunState::kPaused;
  return state_;
}

RunState RunLoop::stop() {
  if (state_ == RunState::kStopped) return state_;
  state_ = RunState::kStopping;
  try {
    simulation_.step();  // scripts see that it is the last step
  } catch (const Diverged&) {
    // It is reset now.
  }
  if (options_.ends_at_stop) {
    ending_ = true;
    return state_;
  }
  simulation_.stop_systems();
  simulation_.reset();
  triggers_ = 0;
  state_ = RunState::kStopped;
  return state_;
}

void RunLoop::step(std::uint64_t count, const StepOrder::Answer& answer) {
  const auto refuse = [&](const std::string& why) {
    answer->set_exception(std::make_exception_ptr(NotCarriedOut(why)));
  };
  if (order_) return refuse("the simulation is already being stepped, by another request");
  if (state_ == RunState::kStopped) return refuse("the simulation is stopped: start it first");
  if (state_ != RunState::kPaused) return refuse("the simulation is running by itself: pause it first");
  if (count == 0) return answer->set_value(simulation_.time());
  order_.begin(count, answer);
}

void RunLoop::set_synchronous(bool synchronous) {
  synchronous_ = synchronous;
  if (!synchronous) triggers_ = 0;
}

void RunLoop::trigger_step() {
  if (synchronous_) ++triggers_;
}

}  // namespace bubblesim
