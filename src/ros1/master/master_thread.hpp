// SPDX-License-Identifier: BSD-3-Clause
// The one thread that talks to the ROS master, which may be absent, slow or hanging: it waits for a master to appear,
// starts roscpp, and then works through jobs (registrations) in order; when the master goes away, it waits for the
// next.
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
    kAbsent,     ///< the master does not answer; tried again four times a second
    kStarting,   ///< a master answers
    kConnected,  ///< roscpp is started, and the master was there when it was last asked
  };

  using Job = std::function<void()>;

  struct Hooks {
    /// Whether a master answers. Asked until it does; then four times a second and before every job.
    std::function<bool()> check;
    /// Asked once a master answers, before roscpp starts: why this node must not register there, or nothing.
    std::function<std::string()> refusal;
    Job on_absent;     ///< once, if the first try fails or takes too long
    Job on_connected;  ///< once roscpp is started, before any job
    Job on_idle;       ///< while connected, whenever check found the master
    Job on_leaving;    ///< before roscpp is shut down, when it was connected and the master was there when last asked
  };

  /// Hooks run on the new thread. Nothing happens before start().
  explicit MasterThread(Hooks hooks);
  ~MasterThread();

  MasterThread(const MasterThread&) = delete;
  MasterThread& operator=(const MasterThread&) = delete;

  /// ros::init() must have been called, and whatever the hooks refer to must be there.
  void start();

  /// Blocks until the state is kAbsent or kConnected. A master that does not answer in `answer_timeout` counts as
  /// absent; one that does but then takes longer than `start_timeout` is not waited for, nor is any when `is_ending`.
  void wait_for_first_answer(std::chrono::milliseconds answer_timeout, std::chrono::milliseconds start_timeout,
                             const std::function<bool()>& is_ending);

  State state() const;
  /// Why the node must not register at the master that answers; empty when it may, or nobody knows. The state is
  /// kAbsent then, and the question is asked again four times a second.
  std::string refusal() const;

  /// Runs `job` after those posted before, while connected. Jobs not begun when stop() is called are dropped.
  void post(Job job);

  /// Posts `job` and waits until it has run. False when there is no master, or when it has not answered anything for
  /// `deadline`; the job runs later then, and calls before the master's next answer are not even posted.
  bool run(Job job, std::chrono::milliseconds deadline);

  /// Ends the node and the thread, within 2 s; any thread may call it. False if a call that cannot be interrupted (a
  /// name lookup) keeps the thread alive: then nothing that jobs and roscpp refer to may be destroyed.
  bool stop();

 private:
  struct Shared;
  const std::shared_ptr<Shared> shared_;  // the thread's too, which may have to be left behind
};

}  // namespace bubblesim
