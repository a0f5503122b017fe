// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <set>
#include <string>

namespace bubblesim {

/// Notices that the master was replaced by another, or has forgotten this node (`rosnode cleanup`), and tells it again
/// what the node publishes, subscribes and offers. roscpp never does. All of it belongs to the master thread.
class MasterWatch {
 public:
  /// `on_renewed` is called after everything has been registered again.
  explicit MasterWatch(std::function<void()> on_renewed);

  /// Whether a master answers. Registers again if there is need to.
  bool check();

  /// Services that roscpp has registered; what else it has, it tells.
  void add_service(const std::string& name);
  void remove_service(const std::string& name);

 private:
  using Clock = std::chrono::steady_clock;

  enum class Standing { kKnown, kForgotten, kReplaced };
  Standing look_up() const;
  bool renew() const;

  const std::function<void()> on_renewed_;
  std::set<std::string> services_;
  int master_ = 0;  // its process id; 0 before the first answer
  Clock::time_point next_look_{};
};

}  // namespace bubblesim
