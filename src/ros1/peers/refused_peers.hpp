// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <set>
#include <string>

namespace bubblesim {

/// Tells in one line, once for each, which nodes wanted to subscribe to a topic or call a service of this node with
/// another type. roscpp refuses them by itself and tells nobody but its log, at each of their attempts: those lines are
/// taken out of the console's output (not out of /rosout).
class RefusedPeers {
 public:
  /// There may be one at a time; ros::init() must have been called.
  RefusedPeers();
  ~RefusedPeers();

  RefusedPeers(const RefusedPeers&) = delete;
  RefusedPeers& operator=(const RefusedPeers&) = delete;

  /// Whether `line` of roscpp's log is about such a peer; says so if it is the first about it. Any thread may call it.
  bool take(const std::string& line);

 private:
  std::mutex mutex_;
  std::set<std::string> told_;
};

}  // namespace bubblesim
