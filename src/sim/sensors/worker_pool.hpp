// SPDX-License-Identifier: BSD-3-Clause
// The other cores of the machine, for measurements of many rays.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace bubblesim {

/// Threads that wait, without using time, for parts of a task. Any thread may give tasks, also from within a task.
class WorkerPool {
 public:
  using Task = std::function<void(std::size_t)>;

  /// The pool of this process: with the thread that gives a task, as many threads as the process may use cores.
  static WorkerPool& shared();

  explicit WorkerPool(std::size_t workers);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// With the thread that gives a task.
  std::size_t threads() const { return workers_.size() + 1; }

  /// Calls task(0) to task(count - 1), each once, in this thread and the pool's. Returns after all calls; rethrows the
  /// exception of the first part that failed.
  void run(std::size_t count, const Task& task);

 private:
  struct Job;

  void serve();
  void do_part(Job& job, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable changed_;  // a job was added, or a part of one ended
  std::list<Job*> jobs_;             // those with parts that no thread has begun
  bool ending_ = false;
  std::vector<std::thread> workers_;
};

/// Cores that this process may use: taskset and containers can leave it a part of the machine's.
std::size_t usable_cores();

/// Rays, or pixels, from which on a measurement is worth more than one thread: about a tenth of a millisecond.
constexpr std::size_t kRaysWorthThreads = 4096;

}  // namespace bubblesim
