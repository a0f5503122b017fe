// SPDX-License-Identifier: BSD-3-Clause
// The only thread that calls the ROS master, which may be absent, slow or hanging. It waits for a master, starts
// roscpp, and then runs jobs (registrations) in order; when the master disappears, it waits for the next.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace bubblesim {

class MasterThread {
 public:
  enum class State {
    kTrying,     ///< no answer yet to the first call
    kAbsent,     ///< the master does not answer; retried four times a second
    kStarting,   ///< a master has answered
    kConnected,  ///< roscpp is started, and the master answered the last check
  };

  using Job = std::function<void()>;

  struct Hooks {
    /// Whether a master answers. Called until it does; then four times a second and before every job.
    std::function<bool()> check;
    /// Called once a master answers, before roscpp starts: why this node must not register there, or empty.
    std::function<std::string()> refusal;
    Job on_absent;  ///< once, if the first try fails or takes too long
    /// Without an answer for 5 s, if there was a master, and then every 10 s. Called on another thread.
    std::function<void(bool had_master)> on_silence;
    Job on_connected;  ///< once after roscpp is started, before any job
    Job on_idle;       ///< while connected, after each successful check
    Job on_leaving;    ///< before roscpp is shut down, if connected and the master answered the last check
  };

  /// Hooks run on the new thread. Nothing happens before start().
  explicit MasterThread(Hooks hooks);
  ~MasterThread();

  MasterThread(const MasterThread&) = delete;
  MasterThread& operator=(const MasterThread&) = delete;

  /// Call it after ros::init(); everything that the hooks use must exist.
  void start();

  /// Blocks until the state is kAbsent or kConnected. A master that does not answer within `answer_timeout` counts as
  /// absent. Stops waiting if starting takes longer than `start_timeout`, or when `is_ending` returns true.
  void wait_for_first_answer(std::chrono::milliseconds answer_timeout, std::chrono::milliseconds start_timeout,
                             const std::function<bool()>& is_ending);

  State state() const;
  /// Why the node must not register at the current master; empty if it may, or if unknown. The state is then kAbsent,
  /// and the check is repeated four times a second.
  std::string refusal() const;

  /// Runs `job` after those posted before, while connected. Jobs that have not started when stop() is called are
  /// dropped.
  void post(Job job);

  /// Posts `job` and waits until it has run. Returns false without a master, or if the master has not answered for
  /// `deadline`; the job then runs later, and calls before the master's next answer are not even posted.
  bool run(Job job, std::chrono::milliseconds deadline);

  /// Ends the node and the thread, within 2 s. Thread-safe. Returns false if a call that cannot be interrupted (a name
  /// lookup) keeps the thread alive: then nothing that jobs and roscpp refer to may be destroyed.
  bool stop();
  /// Destroys the jobs that stop() left. What they hold may refer to what is older than this thread.
  void drop_jobs();

 private:
  struct Shared;
  const std::shared_ptr<Shared> shared_;  // shared with the thread, which may outlive this object
};

}  // namespace bubblesim
