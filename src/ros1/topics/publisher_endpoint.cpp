// SPDX-License-Identifier: BSD-3-Clause
#include <ros/advertise_options.h>
#include <ros/poll_manager.h>
#include <ros/publication.h>
#include <ros/subscriber_link.h>
#include <ros/topic_manager.h>

#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>

#include "topics/endpoints.hpp"

namespace bubblesim {
namespace {

using messages::MessageType;
using messages::WireBuffer;
using Clock = std::chrono::steady_clock;

// roscpp sends on its own thread, does not report when it is done, and drops what is left of a publisher that ends.
constexpr std::chrono::milliseconds kSending{100};
std::atomic<Clock::time_point> last_message_of_all{};  // as roscpp's thread, it serves all publishers

// roscpp rewrites the header's sequence number on its own thread, where an error would end the process.
void check_header(const MessageType& type, const WireBuffer& message) {
  constexpr std::size_t kBeforeFrameId = 12;  // seq, secs, nsecs
  constexpr std::size_t kMinimum = kBeforeFrameId + sizeof(std::uint32_t);
  std::uint32_t frame_id_length = 0;
  if (message.size() >= kMinimum) {
    std::memcpy(&frame_id_length, message.data() + kBeforeFrameId, sizeof(frame_id_length));
    if (message.size() - kMinimum >= frame_id_length) return;
  }
  throw std::invalid_argument("message of type " + type.name + " ends within its header");
}

/// Passes the buffer's storage to roscpp, length first, without a copy.
ros::SerializedMessage to_serialized(WireBuffer message) {
  const std::size_t size = message.size();
  if (size > std::numeric_limits<std::uint32_t>::max() - WireBuffer::kPrefix) {
    throw std::invalid_argument("message of " + std::to_string(size) + " bytes: ROS messages hold less than 4 GiB");
  }
  std::unique_ptr<std::uint8_t[]> storage = message.release();
  const auto length = static_cast<std::uint32_t>(size);
  std::memcpy(storage.get(), &length, sizeof(length));
  ros::SerializedMessage serialized(boost::shared_array<std::uint8_t>(storage.release()), WireBuffer::kPrefix + size);
  serialized.message_start = serialized.buf.get() + WireBuffer::kPrefix;
  return serialized;
}

}  // namespace

PublisherEndpoint::PublisherEndpoint(std::string topic, const MessageType& type, std::uint32_t queue_size, bool latch)
    : topic_(std::move(topic)),
      type_(type),
      queue_size_(queue_size),
      latch_(latch ? std::make_shared<Latch>() : nullptr) {}

std::shared_ptr<PublisherEndpoint> PublisherEndpoint::unregistered_copy() const {
  auto copy = std::make_shared<PublisherEndpoint>(topic_, type_, queue_size_, latch_ != nullptr);
  copy->set_aside(aside_);
  return copy;
}

bool PublisherEndpoint::has_subscribers() const {
  return registered_.load(std::memory_order_acquire) && publication_->hasSubscribers();
}

std::size_t PublisherEndpoint::subscribers() const {
  return registered_.load(std::memory_order_acquire) ? publication_->getNumSubscribers() : 0;
}

void PublisherEndpoint::publish(WireBuffer message) {
  if (!wants_messages()) return;
  if (type_.has_header) check_header(type_, message);
  ros::SerializedMessage serialized = to_serialized(std::move(message));
  if (latch_) {
    const std::lock_guard lock(latch_->mutex);
    latch_->message = serialized;
  }
  // After setting the latch: a subscriber that connects in between gets the message from the latch.
  if (has_subscribers()) send(std::move(serialized));
}

void PublisherEndpoint::send(ros::SerializedMessage message) {
  const Clock::time_point now = Clock::now();
  last_message_ = now;
  last_message_of_all = now;
  publication_->publish(message);
  ros::PollManager::instance()->getPollSet().signal();
}

void PublisherEndpoint::register_at_master() {
  // roscpp warns about empty definitions; gencpp writes an empty line for such types, for example std_msgs/Empty.
  const std::string definition = type_.definition.empty() ? "\n" : type_.definition;
  ros::AdvertiseOptions options(topic_, queue_size_, type_.type_hash, type_.name, definition);
  options.latch = latch_ != nullptr;
  options.has_header = type_.has_header;
  callbacks_ = boost::make_shared<ros::SubscriberCallbacks>();
  ros::SerializedMessage latched_before;
  if (latch_) {
    callbacks_->push_latched_message_ = [latch = latch_](const ros::SubscriberLinkPtr& subscriber) {
      const std::lock_guard lock(latch->mutex);
      if (latch->message.buf) subscriber->enqueueMessage(latch->message, true, true);
    };
    const std::lock_guard lock(latch_->mutex);
    latched_before = latch_->message;
  }
  const auto& topics = ros::TopicManager::instance();
  const bool shares_topic = topics->lookupPublication(topic_) != nullptr;
  if (!topics->advertise(options, callbacks_)) return;  // the node is shutting down
  publication_ = topics->lookupPublication(topic_);
  if (!publication_) return;
  registered_.store(true, std::memory_order_release);
  if (!latch_) return;
  // Subscribers that connected before the registration only have the message latched at that time.
  ros::SerializedMessage latched;
  {
    const std::lock_guard lock(latch_->mutex);
    latched = latch_->message;
  }
  if (latched.buf && (shares_topic || latched.buf != latched_before.buf)) send(latched);
}

void PublisherEndpoint::unregister_from_master() {
  if (!callbacks_) return;
  std::this_thread::sleep_until(last_message_.load() + kSending);
  ros::TopicManager::instance()->unadvertise(topic_, callbacks_);
}

void wait_until_all_are_sent() { std::this_thread::sleep_until(last_message_of_all.load() + kSending); }

}  // namespace bubblesim
