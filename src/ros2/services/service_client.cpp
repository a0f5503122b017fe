// SPDX-License-Identifier: BSD-3-Clause
#include "services/service_client.hpp"

#include <cstring>
#include <utility>

#include "graph/names.hpp"
#include "services/request_id.hpp"

namespace bubblesim::ros2 {

class ServiceClient::RequestListener final : public dds::DataWriterListener {
 public:
  explicit RequestListener(ServiceClient& client) : client_(client) {}

  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    if (is_of_cyclone(guid_of(status.last_subscription_handle))) {
      client_.cyclone_servers_ += status.current_count_change;
    }
    client_.servers_ = status.current_count;
    client_.queue_.wake();
  }

 private:
  ServiceClient& client_;
};

class ServiceClient::ReplyListener final : public dds::DataReaderListener {
 public:
  explicit ReplyListener(ServiceClient& client) : client_(client) {}

  void on_data_available(dds::DataReader* reader) override {
    std::vector<std::uint8_t> message;
    dds::SampleInfo info;
    while (take(*reader, message, info)) {
      if (info.valid_data) client_.receive(info, std::exchange(message, {}));
    }
  }
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    client_.repliers_ = status.current_count;
    client_.queue_.wake();
  }

 private:
  ServiceClient& client_;
};

ServiceClient::ServiceClient(Participant& participant, std::string name, const messages::ServiceType& type,
                             RequestQueue& queue)
    : name_(std::move(name)),
      type_(type),
      queue_(queue),
      request_listener_(std::make_unique<RequestListener>(*this)),
      reply_listener_(std::make_unique<ReplyListener>(*this)),
      replies_(std::make_unique<Reader>(participant, reply_topic(name_, type), messages::Qos(), reply_listener_.get())),
      requests_(std::make_unique<Writer>(participant, request_topic(name_, type), messages::Qos(),
                                         request_listener_.get())) {}

ServiceClient::~ServiceClient() = default;

std::optional<std::int64_t> ServiceClient::send(messages::WireBuffer request) {
  // A server with Cyclone DDS takes the number from the header, one with Fast DDS that of the sample: they count alike.
  const std::lock_guard lock(mutex_);  // so that no reply comes before its number is known
  rtps::WriteParams parameters;
  parameters.related_sample_identity().writer_guid(replies_->guid());
  if (cyclone_servers_ > 0) {
    CycloneHeader header{};
    const std::int64_t number = ++cyclone_number_;
    const Guid own = requests_->guid();
    std::memcpy(header.data(), own.guidPrefix.value + 8, 4);
    std::memcpy(header.data() + 4, own.entityId.value, 4);
    std::memcpy(header.data() + 8, &number, sizeof(number));
    messages::WireBuffer whole = with_header(header, request);
    if (!write(**requests_, whole, parameters)) return std::nullopt;
    calls_[-number];
    return -number;
  }
  if (!write(**requests_, request, parameters)) return std::nullopt;
  const auto number = static_cast<std::int64_t>(parameters.sample_identity().sequence_number().to64long());
  calls_[number];
  return number;
}

void ServiceClient::receive(const dds::SampleInfo& info, std::vector<std::uint8_t> message) {
  const std::lock_guard lock(mutex_);
  std::int64_t number = 0;
  if (is_of_cyclone(info.sample_identity.writer_guid())) {
    const Guid own = requests_->guid();
    const bool is_ours = message.size() >= sizeof(CycloneHeader) &&
                         std::memcmp(message.data(), own.guidPrefix.value + 8, 4) == 0 &&
                         std::memcmp(message.data() + 4, own.entityId.value, 4) == 0;
    if (!is_ours) return;
    std::memcpy(&number, message.data() + 8, sizeof(number));
    number = -number;
    message.erase(message.begin(), message.begin() + sizeof(CycloneHeader));
  } else {
    const Guid& client = info.related_sample_identity.writer_guid();
    if (client != replies_->guid() && client != requests_->guid()) return;  // another client's
    number = static_cast<std::int64_t>(info.related_sample_identity.sequence_number().to64long());
  }
  const auto call = calls_.find(number);
  if (call == calls_.end()) return;
  call->second = std::move(message);
  queue_.wake();
}

std::optional<std::vector<std::uint8_t>> ServiceClient::take_reply(std::int64_t number) {
  const std::lock_guard lock(mutex_);
  const auto call = calls_.find(number);
  if (call == calls_.end() || !call->second) return std::nullopt;
  std::vector<std::uint8_t> reply = std::move(*call->second);
  calls_.erase(call);
  return reply;
}

void ServiceClient::forget(std::int64_t number) {
  const std::lock_guard lock(mutex_);
  calls_.erase(number);
}

}  // namespace bubblesim::ros2
