// SPDX-License-Identifier: BSD-3-Clause
#include "services/service_client.hpp"

#include <cstring>
#include <utility>

#include "graph/names.hpp"
#include "services/request_id.hpp"

namespace bubblesim::ros2 {
namespace {

/// A reader of Cyclone DDS takes only what is written after it has found the writer, which may be later than here.
constexpr std::chrono::milliseconds kCycloneDelay{1500};

}  // namespace

class ServiceClient::RequestListener final : public dds::DataWriterListener {
 public:
  explicit RequestListener(ServiceClient& client) : client_(client) {}

  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    if (is_of_cyclone(guid_of(status.last_subscription_handle))) {
      client_.cyclone_servers_ += status.current_count_change;
      client_.cyclone_found_ = std::chrono::steady_clock::now();
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
                             RequestQueue& queue, CallbackGuard& guard)
    : name_(std::move(name)),
      type_(type),
      queue_(queue),
      guard_(guard),
      request_listener_(std::make_unique<RequestListener>(*this)),
      reply_listener_(std::make_unique<ReplyListener>(*this)),
      replies_(std::make_unique<Reader>(participant, reply_topic(name_, type), messages::Qos(), reply_listener_.get())),
      requests_(std::make_unique<Writer>(participant, request_topic(name_, type), messages::Qos(),
                                         request_listener_.get())) {}

ServiceClient::~ServiceClient() = default;

bool ServiceClient::is_ready() const {
  if (servers_ == 0 || repliers_ == 0) return false;
  return cyclone_servers_ == 0 || std::chrono::steady_clock::now() - cyclone_found_.load() > kCycloneDelay;
}

std::optional<std::int64_t> ServiceClient::send(messages::WireBuffer request) { return send(std::move(request), {}); }

void ServiceClient::call_later(messages::WireBuffer request, messages::MessageCallback on_response) {
  send(std::move(request), {{}, std::make_shared<messages::MessageCallback>(std::move(on_response))});
}

std::optional<std::int64_t> ServiceClient::send(messages::WireBuffer request, Call call) {
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
    calls_[-number] = std::move(call);
    return -number;
  }
  if (!write(**requests_, request, parameters)) return std::nullopt;
  const auto number = static_cast<std::int64_t>(parameters.sample_identity().sequence_number().to64long());
  calls_[number] = std::move(call);
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
  if (!call->second.on_response) {
    call->second.reply = std::move(message);
    queue_.wake();
    return;
  }
  queue_.add([&guard = guard_, open = std::weak_ptr<bool>(open_), on_response = std::move(call->second.on_response),
              reply = std::move(message)] {
    if (open.expired()) return;
    guard.run([&] { (*on_response)(messages::WireView(reply.data(), reply.size())); });
  });
  calls_.erase(call);
}

std::optional<std::vector<std::uint8_t>> ServiceClient::take_reply(std::int64_t number) {
  const std::lock_guard lock(mutex_);
  const auto call = calls_.find(number);
  if (call == calls_.end() || !call->second.reply) return std::nullopt;
  std::vector<std::uint8_t> reply = std::move(*call->second.reply);
  calls_.erase(call);
  return reply;
}

void ServiceClient::forget(std::int64_t number) {
  const std::lock_guard lock(mutex_);
  calls_.erase(number);
}

}  // namespace bubblesim::ros2
