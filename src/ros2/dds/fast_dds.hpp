// SPDX-License-Identifier: BSD-3-Clause
// Fast DDS, of Debian 12 (2.9) or 13 (3.1): this file alone knows in what they differ.
#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#if __has_include(<fastdds/config.hpp>)
#include <fastdds/config.hpp>
#include <fastdds/rtps/common/WriteParams.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#endif

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "bubblesim/messages/wire.hpp"

namespace bubblesim::ros2 {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;

#if defined(FASTDDS_VERSION_MAJOR) && FASTDDS_VERSION_MAJOR >= 3
namespace rtps = eprosima::fastdds::rtps;
using Duration = dds::Duration_t;
using IpLocator = rtps::IPLocator;
inline bool is_ok(dds::ReturnCode_t code) { return code == dds::RETCODE_OK; }
#else
namespace rtps = eprosima::fastrtps::rtps;
using Duration = eprosima::fastrtps::Duration_t;
using IpLocator = rtps::IPLocator;
inline bool is_ok(const ReturnCode_t& code) { return code == ReturnCode_t::RETCODE_OK; }
inline bool is_ok(bool written) { return written; }
#endif

using Guid = rtps::GUID_t;

/// A type whose samples are bytes in CDR: a messages::WireBuffer to write, a std::vector<std::uint8_t> to read into.
class BytesType final : public dds::TopicDataType {
 public:
  explicit BytesType(const std::string& name) {
#if defined(FASTDDS_VERSION_MAJOR) && FASTDDS_VERSION_MAJOR >= 3
    set_name(name);
    max_serialized_type_size = kUsualSize;
    is_compute_key_provided = false;
#else
    setName(name.c_str());
    m_typeSize = kUsualSize;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
#endif
  }

#if defined(FASTDDS_VERSION_MAJOR) && FASTDDS_VERSION_MAJOR >= 3
  bool serialize(const void* sample, rtps::SerializedPayload_t& payload, dds::DataRepresentationId_t) override {
    return write(sample, payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* sample) override { return read(payload, sample); }
  std::uint32_t calculate_serialized_size(const void* sample, dds::DataRepresentationId_t) override {
    return size_of(sample);
  }
  void* create_data() override { return new std::vector<std::uint8_t>(); }  // NOLINT: the interface of Fast DDS
  void delete_data(void* sample) override { delete static_cast<std::vector<std::uint8_t>*>(sample); }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void*, rtps::InstanceHandle_t&, bool) override { return false; }
#else
  bool serialize(void* sample, rtps::SerializedPayload_t* payload) override { return write(sample, *payload); }
  bool deserialize(rtps::SerializedPayload_t* payload, void* sample) override { return read(*payload, sample); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override {
    return [sample] { return size_of(sample); };
  }
  void* createData() override { return new std::vector<std::uint8_t>(); }  // NOLINT: the interface of Fast DDS
  void deleteData(void* sample) override { delete static_cast<std::vector<std::uint8_t>*>(sample); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
#endif

 private:
  static constexpr std::uint32_t kUsualSize = 256;          // larger messages get more memory when they come
  static constexpr std::uint8_t kHeader[4] = {0, 1, 0, 0};  // plain CDR, little-endian, no options

  static std::uint32_t size_of(const void* sample) {
    return static_cast<std::uint32_t>(sizeof(kHeader) + static_cast<const messages::WireBuffer*>(sample)->size());
  }
  static bool write(const void* sample, rtps::SerializedPayload_t& payload) {
    const auto& message = *static_cast<const messages::WireBuffer*>(sample);
    if (size_of(sample) > payload.max_size) return false;
    std::memcpy(payload.data, kHeader, sizeof(kHeader));
    if (message.size() != 0) std::memcpy(payload.data + sizeof(kHeader), message.data(), message.size());
    payload.length = size_of(sample);
    payload.encapsulation = CDR_LE;
    return true;
  }
  static bool read(const rtps::SerializedPayload_t& payload, void* sample) {
    const bool is_understood = payload.length >= sizeof(kHeader) && payload.data[0] == 0 && payload.data[1] == 1;
    if (!is_understood) return false;  // of a big-endian machine, or another encoding
    static_cast<std::vector<std::uint8_t>*>(sample)->assign(payload.data + sizeof(kHeader),
                                                            payload.data + payload.length);
    return true;
  }
};

/// Sends a message. Returns false if it was not sent within the writer's max_blocking_time.
inline bool write(dds::DataWriter& writer, messages::WireBuffer& message) { return is_ok(writer.write(&message)); }
inline bool write(dds::DataWriter& writer, messages::WireBuffer& message, rtps::WriteParams& parameters) {
  return is_ok(writer.write(&message, parameters));
}

/// Takes the next message of a reader. Returns false if there is none.
inline bool take(dds::DataReader& reader, std::vector<std::uint8_t>& message, dds::SampleInfo& info) {
  return is_ok(reader.take_next_sample(&message, &info));
}

inline Guid guid_of(const rtps::InstanceHandle_t& handle) { return rtps::iHandle2GUID(handle); }

/// A remote reader or writer that appears or disappears.
struct DiscoveredEndpoint {
  Guid guid;
  std::string topic;
  std::string type;
  bool reliable = true;
  bool transient_local = false;
  bool removed = false;
};

/// Calls functions when remote readers and writers appear and disappear, on a thread of Fast DDS.
class DiscoveryListener final : public dds::DomainParticipantListener {
 public:
  std::function<void(const DiscoveredEndpoint&)> on_reader;
  std::function<void(const DiscoveredEndpoint&)> on_writer;

#if defined(FASTDDS_VERSION_MAJOR) && FASTDDS_VERSION_MAJOR >= 3
  void on_data_reader_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryStatus status,
                                const dds::SubscriptionBuiltinTopicData& data, bool&) override {
    if (on_reader) on_reader(endpoint(data, data.guid, status == rtps::ReaderDiscoveryStatus::REMOVED_READER));
  }
  void on_data_writer_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryStatus status,
                                const dds::PublicationBuiltinTopicData& data, bool&) override {
    if (on_writer) on_writer(endpoint(data, data.guid, status == rtps::WriterDiscoveryStatus::REMOVED_WRITER));
  }
#else
  void on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& found) override {
    if (on_reader) on_reader(endpoint(found.info, found.status == rtps::ReaderDiscoveryInfo::REMOVED_READER));
  }
  void on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) override {
    if (on_writer) on_writer(endpoint(found.info, found.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER));
  }
#endif

 private:
#if defined(FASTDDS_VERSION_MAJOR) && FASTDDS_VERSION_MAJOR >= 3
  template <class Data>
  static DiscoveredEndpoint endpoint(const Data& data, const Guid& guid, bool removed) {
    return {guid,
            data.topic_name.to_string(),
            data.type_name.to_string(),
            data.reliability.kind == dds::RELIABLE_RELIABILITY_QOS,
            data.durability.kind != dds::VOLATILE_DURABILITY_QOS,
            removed};
  }
#else
  template <class Data>
  static DiscoveredEndpoint endpoint(Data& data, bool removed) {
    return {data.guid(),
            data.topicName().to_string(),
            data.typeName().to_string(),
            data.m_qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS,
            data.m_qos.m_durability.kind != dds::VOLATILE_DURABILITY_QOS,
            removed};
  }
#endif
};

}  // namespace bubblesim::ros2
