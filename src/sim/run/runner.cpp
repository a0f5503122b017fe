// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/runner.hpp"

#include <atomic>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "run/run_loop.hpp"

namespace bubblesim {
namespace {

void check_speed(double speed) {
  if (!(speed > 0)) {
    throw InvalidInput("the speed of a runner must be positive, or infinity for as fast as possible");
  }
}

/// The loop of a new runner makes its first frame at once, which another runner would disturb.
Simulation& unclaimed(Simulation& simulation) {
  simulation.world().access().check_can_be_claimed();
  return simulation;
}

}  // namespace

struct Runner::Impl {
  Impl(Simulation& simulation, const RunnerOptions& options) : loop(unclaimed(simulation), options) {
    check_speed(options.speed);
  }

  template <class Action>
  auto command(Command::Kind kind, Action action) {
    using Result = std::invoke_result_t<Action, RunLoop&>;
    const auto answer = std::make_shared<std::promise<Result>>();
    auto carry_out = [this, answer, action](const Hook& before_answer) {
      const auto act = [&] { return action(loop); };
      fulfil(*answer, act, before_answer);
    };
    auto refuse = [answer](const std::exception_ptr& why) { answer->set_exception(why); };
    loop.inbox().put({kind, std::move(carry_out), std::move(refuse)});
    return answer->get_future();
  }

  /// The loop uses `what` without a lock. Throws std::logic_error when another thread is in the loop.
  void check_thread(const char* what) const {
    const std::thread::id running = runs_in;
    if (running == std::thread::id() || running == std::this_thread::get_id()) return;
    throw std::logic_error(std::string("the ") + what +
                           " of a running Runner can be used in its own thread only: do it before the run, or in a "
                           "function that the runner calls, such as that of call()");
  }

  RunLoop loop;
  std::atomic<std::thread::id> runs_in{};
  std::thread background;
  std::exception_ptr error;  // of the background
};

Runner::Runner(Simulation& simulation, RunnerOptions options)
    : simulation_(simulation), options_(std::move(options)), impl_(std::make_unique<Impl>(simulation_, options_)) {}

Runner::~Runner() {
  try {
    finish();
  } catch (...) {  // NOLINT(bugprone-empty-catch): documented
  }
}

std::future<RunState> Runner::start() {
  return impl_->command(Command::Kind::kStart, [](RunLoop& loop) { return loop.start(); });
}

std::future<RunState> Runner::pause() {
  return impl_->command(Command::Kind::kPause, [](RunLoop& loop) { return loop.pause(); });
}

std::future<RunState> Runner::stop() {
  return impl_->command(Command::Kind::kStop, [](RunLoop& loop) { return loop.stop(); });
}

std::future<double> Runner::step(std::uint64_t count) {
  const auto answer = std::make_shared<std::promise<double>>();
  if (is_this_thread()) {
    answer->set_exception(std::make_exception_ptr(
        NotCarriedOut("the simulation is already being stepped, by the step that made this request")));
  } else {
    put([this, count, answer](const Hook&) { impl_->loop.step(count, answer); },
        [answer](const std::exception_ptr& why) { answer->set_exception(why); });
  }
  return answer->get_future();
}

void Runner::request_steps(std::uint64_t count) {
  const auto unread = std::make_shared<std::promise<double>>();
  put([this, count, unread](const Hook&) { impl_->loop.step(count, unread); }, [](const std::exception_ptr&) {});
}

std::future<void> Runner::set_speed(double speed) {
  check_speed(speed);
  return call([this, speed] { impl_->loop.set_speed(speed); });
}

double Runner::speed() const { return impl_->loop.speed(); }

std::future<void> Runner::set_synchronous(bool synchronous) {
  return call([this, synchronous] { impl_->loop.set_synchronous(synchronous); });
}

std::future<void> Runner::trigger_step() {
  return call([this] { impl_->loop.trigger_step(); });
}

std::future<void> Runner::end() {
  return call([this] { impl_->loop.end(); });
}

void Runner::put(std::function<void(const Hook&)> run, std::function<void(const std::exception_ptr&)> refuse) {
  impl_->loop.inbox().put({Command::Kind::kOther, std::move(run), std::move(refuse)});
}

RunState Runner::state() const { return impl_->loop.state(); }

bool Runner::is_running() const { return impl_->runs_in.load() != std::thread::id(); }

bool Runner::is_this_thread() const { return impl_->runs_in == std::this_thread::get_id(); }

bool Runner::stop_is_due() const {
  return state() == RunState::kStopping || impl_->loop.inbox().has(Command::Kind::kStop);
}

void Runner::wake() { impl_->loop.inbox().wake(); }

std::shared_ptr<const Frame> Runner::frame() const { return impl_->loop.frame(); }

FrameMemory& Runner::share_frames() {
  impl_->check_thread("frame memory");
  return impl_->loop.share_frames();
}

RunReport Runner::take_report() { return impl_->loop.meter().take(); }

std::string Runner::summary() { return impl_->loop.meter().summary(); }

void Runner::report_failure(const std::string& why) { impl_->loop.meter().fail(why); }

GateId Runner::add_gate(StepGate gate) {
  impl_->check_thread("gates");
  return impl_->loop.add_gate(std::move(gate));
}

void Runner::remove_gate(GateId gate) {
  impl_->check_thread("gates");
  impl_->loop.remove_gate(gate);
}

void Runner::remove_gates() {
  impl_->check_thread("gates");
  impl_->loop.remove_gates();
}

void Runner::add_descriptor(std::shared_ptr<WatchedDescriptor> descriptor) {
  impl_->check_thread("watched files");
  impl_->loop.descriptors().add(std::move(descriptor));
}

void Runner::remove_descriptor(const WatchedDescriptor& descriptor) {
  impl_->check_thread("watched files");
  impl_->loop.descriptors().remove(descriptor);
}

void Runner::run() {
  /// Knows the thread, and lets no command wait for ever.
  struct Running {
    explicit Running(Impl& runner) : impl(runner) {
      impl.runs_in = std::this_thread::get_id();
      impl.loop.inbox().open();
    }
    ~Running() {
      impl.loop.close();
      impl.runs_in = std::thread::id();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    Impl& impl;
  };
  const Running running(*impl_);
  impl_->loop.run();
}

void Runner::run_in_background() {
  if (impl_->background.joinable()) throw std::logic_error("the runner runs already");
  impl_->loop.inbox().open();  // commands that come before the thread does wait for it
  std::promise<void> claimed;
  std::future<void> ready = claimed.get_future();
  impl_->background = std::thread([this, claimed = std::move(claimed)]() mutable {
    std::optional<AccessLock::Claim> alone;
    try {
      alone.emplace(simulation_.world().access());
      simulation_.check_may_change();  // a step that lets others use the simulation, and then goes on
    } catch (...) {
      claimed.set_exception(std::current_exception());
      return;
    }
    impl_->runs_in = std::this_thread::get_id();
    claimed.set_value();
    try {
      run();
    } catch (...) {
      impl_->error = std::current_exception();
    }
  });
  try {
    ready.get();
  } catch (...) {
    impl_->background.join();
    impl_->loop.inbox().close();
    throw;
  }
}

void Runner::finish() {
  if (impl_->background.joinable()) {
    end();
    impl_->background.join();
  }
  impl_->loop.inbox().close();
  if (impl_->error) std::rethrow_exception(std::exchange(impl_->error, nullptr));
}

}  // namespace bubblesim
