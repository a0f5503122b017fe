// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "dds/participant.hpp"
#include "services/request_id.hpp"

namespace bubblesim::ros2 {

class LateReplies;

/// Sends the replies of a service. A client may ask before its reader of replies is known here: such a reply waits for
/// it, on another thread. Thread-safe.
class ReplyWriter : public std::enable_shared_from_this<ReplyWriter> {
 public:
  ReplyWriter(Participant& participant, const TopicName& name, const messages::Qos& qos, LateReplies& late);
  ~ReplyWriter();
  ReplyWriter(const ReplyWriter&) = delete;
  ReplyWriter& operator=(const ReplyWriter&) = delete;

  void send(const RequestId& id, messages::WireBuffer reply);
  /// Whether the client's reader is known.
  bool reaches(const RequestId& id) const;
  void send_now(const RequestId& id, messages::WireBuffer& reply);

 private:
  class Listener;

  LateReplies& late_;
  mutable std::mutex mutex_;
  std::set<Guid> readers_;  // guarded
  std::unique_ptr<Listener> listener_;
  std::unique_ptr<Writer> writer_;
};

/// The replies that wait for the readers of their clients, each a second at most.
class LateReplies {
 public:
  LateReplies();
  ~LateReplies();
  LateReplies(const LateReplies&) = delete;
  LateReplies& operator=(const LateReplies&) = delete;

  void add(std::shared_ptr<ReplyWriter> writer, const RequestId& id, messages::WireBuffer reply);
  /// Keeps the writer of a service that ends for a second: clients may have to ask for lost replies.
  void keep(std::shared_ptr<ReplyWriter> writer);
  /// To be called when a reader has appeared.
  void wake();

 private:
  using Clock = std::chrono::steady_clock;
  struct Ended {
    std::shared_ptr<ReplyWriter> writer;
    Clock::time_point until;
  };
  struct Reply {
    std::shared_ptr<ReplyWriter> writer;
    RequestId id;
    messages::WireBuffer message;
    Clock::time_point deadline;
  };

  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Reply> replies_;  // guarded, like what follows
  std::deque<Ended> ended_;
  bool ending_ = false;
  int wakes_ = 0;
  std::thread thread_;
};

}  // namespace bubblesim::ros2
