// SPDX-License-Identifier: BSD-3-Clause
#include "master/master_thread.hpp"

#include <ros/init.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "advertised_address.hpp"
#include "console/log_line.hpp"
#include "master/interrupt.hpp"
#include "quiet_thread.hpp"

namespace bubblesim {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kCheckInterval = 250ms;
// Parts of the 2 s of stop(): time for a healthy master, then for interrupting calls one by one.
constexpr auto kLetJobFinish = 200ms;
constexpr auto kLetMasterAnswer = 1000ms;
constexpr auto kGiveUp = 1900ms;
constexpr auto kInterruptInterval = 2ms;
constexpr auto kEndingLook = 50ms;
constexpr auto kReportLoss = 5s;  // more than a restart of the master takes
constexpr auto kReportAgain = 10s;

/// Returns the result of `function`; false if it throws, as roscpp does for responses that it does not understand.
template <class Function>
bool run_safely(Function&& function) {
  try {
    return function();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plugin 'ROSInterface': %s\n", error.what());
  } catch (const XmlRpc::XmlRpcException& error) {
    std::fprintf(stderr, "plugin 'ROSInterface': %s\n", error.getMessage().c_str());
  }
  return false;
}

}  // namespace

struct MasterThread::Shared {
  Hooks hooks;

  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Job> jobs;
  std::atomic<State> state{State::kTrying};   // written under the mutex, for the condition variable
  std::uint64_t answers = 0;                  // of the master, counted by check()
  std::optional<std::uint64_t> silent_after;  // number of answers at the last timeout of run()
  Clock::time_point last_answer = Clock::now();
  Clock::time_point reported = last_answer;  // when a silence was reported
  bool reported_absent = false;
  bool first_answer_taken = false;  // wait_for_first_answer() has returned
  std::string refusal;
  bool stopping = false;
  bool finished = false;
  std::mutex stop_mutex;
  std::thread thread;
  std::thread reporter;

  void set_state(State next);
  void set_absent(std::unique_lock<std::mutex>& lock);
  void set_refused(std::unique_lock<std::mutex>& lock, std::string why);
  void note_answer();
  bool find_master();
  void work();
  void run();
  Clock::time_point next_report() const;
  void report_silence();
};

/// Requires the mutex.
void MasterThread::Shared::note_answer() {
  ++answers;
  last_answer = Clock::now();
}

/// Requires the mutex.
void MasterThread::Shared::set_state(State next) {
  state = next;
  changed.notify_all();
}

void MasterThread::Shared::set_absent(std::unique_lock<std::mutex>& lock) {
  set_state(State::kAbsent);
  if (std::exchange(reported_absent, true)) return;
  lock.unlock();
  hooks.on_absent();
  lock.lock();
}

/// The caller that waits for the first answer reports the refusal; a later one is reported here, once.
void MasterThread::Shared::set_refused(std::unique_lock<std::mutex>& lock, std::string why) {
  const bool is_news = refusal.empty() && first_answer_taken;
  refusal = std::move(why);
  set_state(State::kAbsent);
  if (!is_news) return;
  lock.unlock();
  log_line("not registered: " + refusal);
  lock.lock();
}

/// Returns false to stop. NodeHandle and ros::start() would wait forever, so they come after this.
bool MasterThread::Shared::find_master() {
  for (;;) {
    const bool found = run_safely([this] { return hooks.check(); });
    std::unique_lock lock(mutex);
    if (stopping) return false;
    if (found) {
      note_answer();
      if (refusal.empty()) set_state(State::kStarting);
      lock.unlock();
      std::string why;
      run_safely([&] { return why = hooks.refusal(), true; });
      lock.lock();
      if (stopping) return false;
      if (why.empty()) {
        refusal.clear();
        set_state(State::kStarting);
        return true;
      }
      set_refused(lock, std::move(why));
    } else {
      set_absent(lock);
    }
    if (changed.wait_for(lock, kCheckInterval, [this] { return stopping; })) return false;
  }
}

/// A job started without a master would wait for it in roscpp, with locks held that delivery needs.
void MasterThread::Shared::work() {
  bool found = true;
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex);
      set_state(found ? State::kConnected : State::kAbsent);
      const auto is_due = [&] { return stopping || (found && !jobs.empty()); };
      changed.wait_for(lock, kCheckInterval, is_due);
      if (stopping) return;
    }
    found = run_safely([this] { return hooks.check(); });
    {
      const std::lock_guard lock(mutex);
      if (stopping) return;
      if (!found) continue;
      note_answer();
      if (!jobs.empty()) {
        job = std::move(jobs.front());
        jobs.pop_front();
      }
    }
    run_safely([this, &job] { return (job ? job : hooks.on_idle)(), true; });
  }
}

void MasterThread::Shared::run() {
  if (find_master()) {
    {
      const AdvertisedAddress alone;
      ros::start();
    }
    bool go_on = false;
    {
      const std::lock_guard lock(mutex);
      go_on = !stopping;
    }
    if (go_on) {
      hooks.on_connected();
      work();
      if (state == State::kConnected) run_safely([this] { return hooks.on_leaving(), true; });
    }
    ros::shutdown();  // or wait for the shutdown that stop() started
  }
  {
    const std::lock_guard lock(mutex);
    finished = true;
  }
  changed.notify_all();
}

/// Requires the mutex. The first silence of all is reported by on_absent().
Clock::time_point MasterThread::Shared::next_report() const {
  if (reported > last_answer) return reported + kReportAgain;
  return last_answer + (answers > 0 ? kReportLoss : kReportAgain);
}

/// On a thread of its own, because the other one waits for a master that hangs.
void MasterThread::Shared::report_silence() {
  std::unique_lock lock(mutex);
  while (!stopping) {
    if (Clock::now() < next_report()) {
      changed.wait_until(lock, next_report(), [this] { return stopping; });
      continue;
    }
    reported = Clock::now();
    const bool had_master = answers > 0;
    lock.unlock();
    hooks.on_silence(had_master);
    lock.lock();
  }
}

MasterThread::MasterThread(Hooks hooks) : shared_(std::make_shared<Shared>()) { shared_->hooks = std::move(hooks); }

void MasterThread::start() {
  shared_->thread = start_without_signals([shared = shared_] { shared->run(); });
  shared_->reporter = start_without_signals([shared = shared_] { shared->report_silence(); });
}

MasterThread::~MasterThread() { stop(); }

void MasterThread::wait_for_first_answer(std::chrono::milliseconds answer_timeout,
                                         std::chrono::milliseconds start_timeout,
                                         const std::function<bool()>& is_ending) {
  std::unique_lock lock(shared_->mutex);
  const auto has_left = [&](State state, std::chrono::milliseconds timeout) {
    const auto end = Clock::now() + timeout;
    while (shared_->state == state && Clock::now() < end && !is_ending()) shared_->changed.wait_for(lock, kEndingLook);
    return shared_->state != state;
  };
  if (has_left(State::kTrying, answer_timeout)) {
    has_left(State::kStarting, start_timeout);
  } else if (!is_ending()) {
    shared_->set_absent(lock);
  }
  shared_->first_answer_taken = true;
}

MasterThread::State MasterThread::state() const { return shared_->state; }

std::string MasterThread::refusal() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->refusal;
}

void MasterThread::post(Job job) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->jobs.push_back(std::move(job));
  }
  shared_->changed.notify_all();
}

bool MasterThread::run(Job job, std::chrono::milliseconds deadline) {
  const auto done = std::make_shared<bool>(false);
  std::unique_lock lock(shared_->mutex);
  const auto is_absent = [this] { return shared_->state == State::kTrying || shared_->state == State::kAbsent; };
  if (is_absent() || shared_->silent_after == shared_->answers) return false;
  shared_->jobs.push_back([job = std::move(job), done, shared = shared_.get()] {
    job();
    {
      const std::lock_guard finished(shared->mutex);
      *done = true;
    }
    shared->changed.notify_all();
  });
  shared_->changed.notify_all();
  for (;;) {
    const std::uint64_t before = shared_->answers;  // a slow machine does not mean an absent master
    const auto is_over = [&] { return *done || shared_->stopping || is_absent() || shared_->answers != before; };
    const bool answered = shared_->changed.wait_for(lock, deadline, is_over);
    if (*done) return true;
    if (!answered) shared_->silent_after = before;
    if (!answered || shared_->stopping || is_absent()) return false;
  }
}

void MasterThread::drop_jobs() {
  std::deque<Job> dropped;  // destroyed without the mutex
  const std::lock_guard lock(shared_->mutex);
  dropped.swap(shared_->jobs);
}

bool MasterThread::stop() {
  const std::lock_guard alone(shared_->stop_mutex);
  if (!shared_->thread.joinable()) return true;
  const auto begin = Clock::now();
  std::unique_lock lock(shared_->mutex);
  shared_->stopping = true;
  shared_->changed.notify_all();
  const auto finished_by = [&](Clock::time_point end) {
    return shared_->changed.wait_until(lock, end, [this] { return shared_->finished; });
  };
  std::thread shutdown;
  if (!finished_by(begin + kLetJobFinish)) {
    // roscpp retries a registration until the master answers or the node shuts down.
    if (ros::isStarted()) shutdown = start_without_signals([] { ros::shutdown(); });
    finished_by(begin + kLetMasterAnswer);
    while (!shared_->finished && Clock::now() < begin + kGiveUp) {
      if (!shutdown.joinable() && ros::isStarted()) shutdown = start_without_signals([] { ros::shutdown(); });
      interrupt_master_calls();
      finished_by(Clock::now() + kInterruptInterval);
    }
  }
  const bool finished = shared_->finished;
  lock.unlock();
  shared_->reporter.join();
  for (std::thread* thread : {&shutdown, &shared_->thread}) {
    if (!thread->joinable()) continue;
    if (finished) {
      thread->join();
    } else {
      thread->detach();
    }
  }
  return finished;
}

}  // namespace bubblesim
