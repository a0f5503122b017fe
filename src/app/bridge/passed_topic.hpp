// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "bubblesim/messages/translator.hpp"
#include "bubblesim/node_bridge.hpp"

namespace bubblesim::app {

/// A topic that is published on one side, in one direction. What nobody receives is not subscribed.
class PassedTopic {
 public:
  /// Advertises the topic on the other side. Throws std::invalid_argument if the types do not fit, or if the topic has
  /// another type on that side.
  PassedTopic(std::string name, NodeBridge& from, NodeBridge& to, const messages::MessageType& from_type,
              const messages::MessageType& to_type, const messages::Qos& qos);
  ~PassedTopic();
  PassedTopic(const PassedTopic&) = delete;
  PassedTopic& operator=(const PassedTopic&) = delete;

  /// Subscribes, or ends that.
  void update();

 private:
  void pass(messages::WireView message);

  const std::string name_;
  NodeBridge& from_;
  NodeBridge& to_;
  const messages::MessageType& type_;
  const messages::Translator translator_;
  const messages::Qos qos_;
  messages::EndpointId publisher_;
  std::optional<messages::EndpointId> subscriber_;
  bool reported_ = false;
};

}  // namespace bubblesim::app
