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

/// Tells in one line, once for each, which publishers of the node's subscriptions have another type: they refuse the
/// connection, and roscpp drops it without a word. All of it belongs to the master thread.
class PublisherCheck {
 public:
  /// A topic may be added several times, and is then to be removed as often.
  void add(const std::string& topic, const messages::MessageType& type);
  void remove(const std::string& topic);

  /// To be called regularly, while there is a master; looks once a second. A publisher that the master knows and
  /// that is not connected at two looks is asked for its type.
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
  std::set<Publisher> missing_;  // at the last look
  std::set<Publisher> asked_;    // of those
  Clock::time_point next_look_{};
};

}  // namespace bubblesim
