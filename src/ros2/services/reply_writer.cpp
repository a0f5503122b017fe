// SPDX-License-Identifier: BSD-3-Clause
#include "services/reply_writer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "quiet_thread.hpp"

namespace bubblesim::ros2 {
namespace {

constexpr std::chrono::seconds kMostWaiting{1};

}  // namespace

class ReplyWriter::Listener final : public dds::DataWriterListener {
 public:
  explicit Listener(ReplyWriter& owner) : owner_(owner) {}

  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    {
      const std::lock_guard lock(owner_.mutex_);
      const Guid reader = guid_of(status.last_subscription_handle);
      if (status.current_count_change > 0) {
        owner_.readers_.insert(reader);
      } else {
        owner_.readers_.erase(reader);
      }
    }
    owner_.late_.wake();
  }

 private:
  ReplyWriter& owner_;
};

ReplyWriter::ReplyWriter(Participant& participant, const TopicName& name, const messages::Qos& qos, LateReplies& late)
    : late_(late),
      listener_(std::make_unique<Listener>(*this)),
      writer_(std::make_unique<Writer>(participant, name, qos, listener_.get())) {}

ReplyWriter::~ReplyWriter() = default;

bool ReplyWriter::reaches(const RequestId& id) const {
  const std::lock_guard lock(mutex_);
  if (!id.is_cyclone) return readers_.count(id.client) > 0;
  // The id is that of the writer of the requests: any reader of the client's process.
  return std::any_of(readers_.begin(), readers_.end(),
                     [&](const Guid& reader) { return reader.guidPrefix == id.client.guidPrefix; });
}

void ReplyWriter::send(const RequestId& id, messages::WireBuffer reply) {
  if (reaches(id)) {
    send_now(id, reply);
  } else {
    late_.add(shared_from_this(), id, std::move(reply));
  }
}

void ReplyWriter::send_now(const RequestId& id, messages::WireBuffer& reply) {
  rtps::WriteParams parameters;
  parameters.related_sample_identity().writer_guid(id.client);
  parameters.related_sample_identity().sequence_number(id.number);
  if (id.is_cyclone) {
    messages::WireBuffer whole = with_header(id.header, reply);
    write(**writer_, whole, parameters);
  } else {
    write(**writer_, reply, parameters);
  }
}

LateReplies::LateReplies() : thread_(start_without_signals([this] { run(); })) {}

LateReplies::~LateReplies() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LateReplies::add(std::shared_ptr<ReplyWriter> writer, const RequestId& id, messages::WireBuffer reply) {
  {
    const std::lock_guard lock(mutex_);
    replies_.push_back({std::move(writer), id, std::move(reply), Clock::now() + kMostWaiting});
    ++wakes_;
  }
  changed_.notify_all();
}

void LateReplies::keep(std::shared_ptr<ReplyWriter> writer) {
  {
    const std::lock_guard lock(mutex_);
    ended_.push_back({std::move(writer), Clock::now() + kMostWaiting});
    ++wakes_;
  }
  changed_.notify_all();
}

void LateReplies::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

void LateReplies::run() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    const int seen = wakes_;
    std::deque<Reply> waiting = std::exchange(replies_, {});
    const auto now = Clock::now();
    std::vector<std::shared_ptr<ReplyWriter>> gone;
    while (!ended_.empty() && ended_.front().until <= now) {
      gone.push_back(std::move(ended_.front().writer));
      ended_.pop_front();
    }
    lock.unlock();  // to write takes locks of Fast DDS, which calls wake() under them
    gone.clear();
    const auto left = std::remove_if(waiting.begin(), waiting.end(), [now](Reply& reply) {
      if (!reply.writer->reaches(reply.id)) return reply.deadline <= now;
      reply.writer->send_now(reply.id, reply.message);
      return true;
    });
    waiting.erase(left, waiting.end());
    lock.lock();
    std::move(waiting.begin(), waiting.end(), std::back_inserter(replies_));
    const auto woken = [&] { return ending_ || wakes_ != seen; };
    auto next = Clock::time_point::max();
    if (!replies_.empty()) next = replies_.front().deadline;
    if (!ended_.empty()) next = std::min(next, ended_.front().until);
    if (next == Clock::time_point::max()) {
      changed_.wait(lock, woken);
    } else {
      changed_.wait_until(lock, next, woken);
    }
  }
}

}  // namespace bubblesim::ros2
