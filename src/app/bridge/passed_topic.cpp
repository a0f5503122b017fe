// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/passed_topic.hpp"

#include <cstdio>
#include <utility>

namespace bubblesim::app {

PassedTopic::PassedTopic(std::string name, NodeBridge& from, NodeBridge& to, const messages::MessageType& from_type,
                         const messages::MessageType& to_type, const messages::Qos& qos)
    : name_(std::move(name)),
      from_(from),
      to_(to),
      type_(from_type),
      translator_(from_type, to_type),
      qos_(qos),
      publisher_(0) {
  messages::Qos offered = qos;
  offered.reliable = true;  // which subscribers of both kinds receive
  publisher_ = to.advertise(name_, to_type, offered);
}

PassedTopic::~PassedTopic() {
  to_.shutdown_publisher(publisher_);
  if (subscriber_) from_.shutdown_subscriber(*subscriber_);
}

void PassedTopic::update() {
  const bool wanted = to_.wants_messages(publisher_);
  if (wanted && !subscriber_) {
    subscriber_ = from_.subscribe(name_, type_, qos_, [this](messages::WireView message) { pass(message); });
  } else if (!wanted && subscriber_) {
    from_.shutdown_subscriber(*subscriber_);
    subscriber_.reset();
  }
}

void PassedTopic::pass(messages::WireView message) {
  try {
    to_.publish(publisher_, translator_.translate(message));
  } catch (const messages::WireError& error) {
    if (!std::exchange(reported_, true)) {
      std::fprintf(stderr, "warning: a message on %s was dropped: %s\n", name_.c_str(), error.what());
    }
  }
}

}  // namespace bubblesim::app
