// SPDX-License-Identifier: BSD-3-Clause
#include "topics/inbox.hpp"

namespace bubblesim::ros2 {

void Inbox::add(const std::shared_ptr<Mailbox>& mailbox, std::vector<std::uint8_t> message) {
  traffic_.note_received(message.size());
  {
    const std::lock_guard lock(mutex_);
    if (mailbox->depth != 0 && mailbox->messages.size() == mailbox->depth) {
      mailbox->messages.pop_front();
      traffic_.note_dropped(mailbox->topic);
    } else {
      order_.push_back(mailbox);
    }
    mailbox->messages.push_back(std::move(message));
  }
  arrivals_.note();
}

bool Inbox::has(const Mailbox& mailbox) const {
  const std::lock_guard lock(mutex_);
  return !mailbox.messages.empty();
}

void Inbox::deliver(CallbackGuard& guard) {
  std::unique_lock lock(mutex_);
  for (std::size_t left = order_.size(); left > 0; --left) {
    const std::shared_ptr<Mailbox> mailbox = std::move(order_.front());
    order_.pop_front();
    const std::vector<std::uint8_t> message = std::move(mailbox->messages.front());
    mailbox->messages.pop_front();
    lock.unlock();
    const auto callback = mailbox->callback;  // it may shut down its subscriber
    if (callback && !mailbox->aside) {
      guard.run([&] { (*callback)(messages::WireView(message.data(), message.size())); });
    }
    lock.lock();
  }
}

}  // namespace bubblesim::ros2
