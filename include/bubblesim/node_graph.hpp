// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace bubblesim {

/// What the other nodes publish, receive and offer, by full names. Types are spelt `pkg/Type`.
struct NodeGraph {
  struct Topic {
    std::string type;
    bool published = false;
    bool subscribed = false;
    bool reliable = true;          ///< of all publishers
    bool transient_local = false;  ///< of a publisher; in ROS 1 not known
  };

  std::map<std::string, Topic> topics;
  std::map<std::string, std::string> services;  ///< types by name
};

}  // namespace bubblesim
