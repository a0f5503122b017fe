// SPDX-License-Identifier: BSD-3-Clause
#include "topics/endpoints.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "graph/names.hpp"

namespace bubblesim::ros2 {

class PublisherEndpoint::Listener final : public dds::DataWriterListener {
 public:
  explicit Listener(std::atomic<int>& subscribers) : subscribers_(subscribers) {}

  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    subscribers_ = status.current_count;
  }

 private:
  std::atomic<int>& subscribers_;
};

PublisherEndpoint::PublisherEndpoint(std::string topic, const messages::MessageType& type, const messages::Qos& qos,
                                     Outbox& outbox)
    : topic_(std::move(topic)),
      type_(type),
      qos_(qos),
      outbox_(outbox),
      listener_(std::make_unique<Listener>(subscribers_)) {}

PublisherEndpoint::~PublisherEndpoint() { close(); }

void PublisherEndpoint::deliver(std::chrono::steady_clock::time_point end) {
  if (!writer_ || subscribers_ == 0) return;
  outbox_.wait_until_written(*outgoing_, end);
  const auto left =
      std::max(std::chrono::nanoseconds(0), std::chrono::nanoseconds(end - std::chrono::steady_clock::now()));
  (**writer_).wait_for_acknowledgments(Duration(0, static_cast<std::uint32_t>(left.count())));
}

void PublisherEndpoint::publish(messages::WireBuffer message) { outbox_.add(outgoing_, std::move(message)); }

void PublisherEndpoint::open(Participant& participant) {
  writer_ = std::make_unique<Writer>(participant, message_topic(topic_, type_), qos_, listener_.get());
  outgoing_ = std::make_shared<Outgoing>(Outgoing{*writer_, qos_.depth, {}});
}

void PublisherEndpoint::close() {
  if (!writer_) return;
  outbox_.drop(*outgoing_);
  outgoing_.reset();
  writer_.reset();
  subscribers_ = 0;
}

class SubscriberEndpoint::Listener final : public dds::DataReaderListener {
 public:
  Listener(Inbox& inbox, std::shared_ptr<Mailbox> mailbox, std::atomic<int>& publishers, bool ignore_own)
      : inbox_(inbox), mailbox_(std::move(mailbox)), publishers_(publishers), ignore_own_(ignore_own) {}

  void on_data_available(dds::DataReader* reader) override {
    std::vector<std::uint8_t> message;
    dds::SampleInfo info;
    while (take(*reader, message, info)) {
      const bool is_own = info.sample_identity.writer_guid().guidPrefix == reader->guid().guidPrefix;
      if (!info.valid_data || (ignore_own_ && is_own)) continue;
      inbox_.add(mailbox_, std::exchange(message, {}));
    }
  }
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    publishers_ = status.current_count;
  }

 private:
  Inbox& inbox_;
  const std::shared_ptr<Mailbox> mailbox_;
  std::atomic<int>& publishers_;
  const bool ignore_own_;
};

SubscriberEndpoint::SubscriberEndpoint(std::string topic, const messages::MessageType& type, const messages::Qos& qos,
                                       messages::MessageCallback callback, Inbox& inbox)
    : topic_(std::move(topic)), type_(type), qos_(qos), inbox_(inbox) {
  mailbox_->topic = topic_;
  mailbox_->depth = qos.depth;
  mailbox_->callback = std::make_shared<messages::MessageCallback>(std::move(callback));
  listener_ = std::make_unique<Listener>(inbox_, mailbox_, publishers_, qos.ignore_own);
}

SubscriberEndpoint::~SubscriberEndpoint() = default;

void SubscriberEndpoint::open(Participant& participant) {
  reader_ = std::make_unique<Reader>(participant, message_topic(topic_, type_), qos_, listener_.get());
}

void SubscriberEndpoint::close() {
  reader_.reset();
  publishers_ = 0;
}

}  // namespace bubblesim::ros2
