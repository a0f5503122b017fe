// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "bubblesim/messages/message_type.hpp"
#include "peers/type_version.hpp"

namespace bubblesim {

/// Reports once, in one line, each publisher of the node's subscriptions with a different type: it refuses the
/// connection, and roscpp drops it without a message. Used by the master thread only.
class PublisherCheck {
 public:
  /// A topic may be added several times, and must then be removed as often.
  void add(const std::string& topic, const messages::MessageType& type);
  void remove(const std::string& topic);

  /// Call it regularly while there is a master; it checks once a second. A publisher that the master lists and that is
  /// not connected in two checks is asked for its type.
  void look();

 private:
  using Clock = std::chrono::steady_clock;
  using Publisher = std::tuple<std::string, std::string, std::string>;  // topic, node, the node's URI

  struct Subscribed {
    TypeVersion type;
    int count = 0;
  };

  std::set<Publisher> missing_publishers() const;

  std::map<std::string, Subscribed> topics_;
  std::set<Publisher> missing_;  // in the last check
  std::set<Publisher> asked_;    // of those
  Clock::time_point next_look_{};
};

}  // namespace bubblesim
