// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bubblesim/messages/bridge.hpp"
#include "callback_guard.hpp"
#include "dds/participant.hpp"
#include "request_queue.hpp"

namespace bubblesim::ros2 {

/// A client of a service. `queue` is woken when the service appears and when a reply arrives.
class ServiceClient {
 public:
  ServiceClient(Participant& participant, std::string name, const messages::ServiceType& type, RequestQueue& queue,
                CallbackGuard& guard);
  ~ServiceClient();
  ServiceClient(const ServiceClient&) = delete;
  ServiceClient& operator=(const ServiceClient&) = delete;

  const std::string& name() const { return name_; }
  const messages::ServiceType& type() const { return type_; }
  /// Whether a server gets requests and its replies arrive.
  bool is_ready() const;
  /// Sends a request and returns its number, or nothing if it could not be sent.
  std::optional<std::int64_t> send(messages::WireBuffer request);
  /// Sends a request; `on_response` is called when `queue` is served. For the simulation's thread.
  void call_later(messages::WireBuffer request, messages::MessageCallback on_response);
  /// Returns the reply to a request, once.
  std::optional<std::vector<std::uint8_t>> take_reply(std::int64_t number);
  /// The reply to this request is not wanted any more.
  void forget(std::int64_t number);

 private:
  class RequestListener;
  class ReplyListener;

  struct Call {
    std::optional<std::vector<std::uint8_t>> reply;          // empty until it arrives
    std::shared_ptr<messages::MessageCallback> on_response;  // null: take_reply() waits for it
  };

  std::optional<std::int64_t> send(messages::WireBuffer request, Call call);
  void receive(const dds::SampleInfo& info, std::vector<std::uint8_t> message);

  const std::string name_;
  const messages::ServiceType& type_;
  RequestQueue& queue_;
  CallbackGuard& guard_;
  const std::shared_ptr<bool> open_ = std::make_shared<bool>(true);  // replies that wait in the queue watch its end
  std::atomic<int> servers_{0};
  std::atomic<int> cyclone_servers_{0};
  std::atomic<std::chrono::steady_clock::time_point> cyclone_found_{};  // the last one
  std::atomic<int> repliers_{0};
  std::mutex mutex_;
  std::map<std::int64_t, Call> calls_;  // guarded
  std::int64_t cyclone_number_ = 0;     // the last one
  std::unique_ptr<RequestListener> request_listener_;
  std::unique_ptr<ReplyListener> reply_listener_;
  std::unique_ptr<Reader> replies_;
  std::unique_ptr<Writer> requests_;
};

}  // namespace bubblesim::ros2
