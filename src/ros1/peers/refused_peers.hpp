// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <set>
#include <string>

namespace bubblesim {

/// Reports once, in one line, each node that tried to subscribe to a topic or call a service of this node with another
/// type, up to a hundred of them. roscpp refuses them and only logs it, at each attempt: removes those lines from the
/// console output (not from /rosout).
class RefusedPeers {
 public:
  /// At most one may exist; call it after ros::init().
  RefusedPeers();
  ~RefusedPeers();

  RefusedPeers(const RefusedPeers&) = delete;
  RefusedPeers& operator=(const RefusedPeers&) = delete;

  /// Returns whether `line` of roscpp's log is about such a peer; reports the first one about it. Thread-safe.
  bool take(const std::string& line);

 private:
  std::mutex mutex_;
  std::set<std::string> reported_;
};

}  // namespace bubblesim
