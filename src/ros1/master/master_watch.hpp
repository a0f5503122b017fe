// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <set>
#include <string>

namespace bubblesim {

/// Detects that another master replaced the master, or that the master removed this node (`rosnode cleanup`), and
/// registers the node's publishers, subscribers and services again. roscpp never does. Used by the master thread only.
class MasterWatch {
 public:
  /// `on_renewed` is called after a complete new registration.
  explicit MasterWatch(std::function<void()> on_renewed);

  /// Returns whether a master answers. Registers again if needed.
  bool check();

  /// Adds a service that roscpp has registered; topics are queried from roscpp.
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
