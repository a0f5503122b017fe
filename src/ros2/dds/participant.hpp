// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "bubblesim/messages/qos.hpp"
#include "dds/environment.hpp"
#include "dds/fast_dds.hpp"

namespace bubblesim::ros2 {

/// The name of a DDS topic with the name and the hash of its type, in the spelling of ROS 2's middlewares.
struct TopicName {
  std::string topic;      ///< `rt/speed`
  std::string type;       ///< `std_msgs::msg::dds_::Float32_`
  std::string type_hash;  ///< `RIHS01_...`
};

/// The ids of the readers and writers that belong to the node, for its announcement.
struct NodeEndpoints {
  std::set<Guid> readers;
  std::set<Guid> writers;
  int revision = 0;
};

/// This process in a domain, reached over UDP by peers on this machine. Endpoints must be destroyed before it.
/// Thread-safe.
///
/// Not by shared memory: Fast DDS 2.9 aborts when a peer with a newer one uses it.
class Participant {
 public:
  /// Throws std::runtime_error if there is no network.
  explicit Participant(const Environment& environment);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  const Guid& guid() const { return participant_->guid(); }
  /// Changes with each change of endpoints().
  int revision() const;
  NodeEndpoints endpoints() const;
  /// The types of the remote readers of a topic, sorted.
  std::set<std::string> types_of_readers(const std::string& topic) const;
  /// The readers and writers of other participants.
  std::vector<DiscoveredEndpoint> remote_readers() const;
  std::vector<DiscoveredEndpoint> remote_writers() const;

 private:
  friend class Writer;
  friend class Reader;
  class Topic;

  using Endpoints = std::map<std::string, std::map<Guid, DiscoveredEndpoint>>;  // by topic

  std::shared_ptr<Topic> topic(const TopicName& name);
  void note(Endpoints& endpoints, const DiscoveredEndpoint& found);
  std::vector<DiscoveredEndpoint> all_of(const Endpoints& endpoints) const;

  DiscoveryListener listener_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::Publisher* publisher_ = nullptr;
  dds::Subscriber* subscriber_ = nullptr;
  mutable std::mutex mutex_;  // guards what follows
  std::map<std::string, std::weak_ptr<Topic>> topics_;
  std::map<std::string, dds::TypeSupport> types_;
  NodeEndpoints endpoints_;
  Endpoints remote_readers_;
  Endpoints remote_writers_;
};

/// A DataWriter of the participant, which must outlive it. The listener too.
class Writer {
 public:
  /// Throws std::runtime_error if Fast DDS refuses it, such as a second type on a topic. `of_node`: it is announced as
  /// the node's.
  Writer(Participant& participant, const TopicName& name, const messages::Qos& qos, dds::DataWriterListener* listener,
         bool of_node = true);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  dds::DataWriter& operator*() const { return *writer_; }
  Guid guid() const { return writer_->guid(); }

 private:
  Participant& participant_;
  const std::shared_ptr<Participant::Topic> topic_;
  dds::DataWriter* writer_;
};

/// The same for a DataReader.
class Reader {
 public:
  Reader(Participant& participant, const TopicName& name, const messages::Qos& qos, dds::DataReaderListener* listener);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  dds::DataReader& operator*() const { return *reader_; }
  Guid guid() const { return reader_->guid(); }

 private:
  Participant& participant_;
  const std::shared_ptr<Participant::Topic> topic_;
  dds::DataReader* reader_;
};

}  // namespace bubblesim::ros2
