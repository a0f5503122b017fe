// SPDX-License-Identifier: BSD-3-Clause
// How a reply finds its request: the middlewares of ROS 2 do it in two ways.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bubblesim/messages/wire.hpp"
#include "dds/fast_dds.hpp"

namespace bubblesim::ros2 {

/// What rmw_cyclonedds writes before the body of a request and of its reply: half of the client's id, and a number.
using CycloneHeader = std::array<std::uint8_t, 16>;

/// The request that a reply answers.
struct RequestId {
  Guid client;  ///< the reader of the replies; of a client with Cyclone DDS, the writer of the requests
  rtps::SequenceNumber_t number;
  bool is_cyclone = false;
  CycloneHeader header{};  ///< if it is one of Cyclone DDS
};

/// Whether a reader or writer is one of Cyclone DDS, by the vendor in its id (OMG's list of DDS vendor ids).
inline bool is_of_cyclone(const Guid& guid) {
  return guid.guidPrefix.value[0] == 1 && guid.guidPrefix.value[1] == 0x10;
}

/// Reads the id of a request, and takes a header of Cyclone DDS off the message. Returns false for a message that is
/// too short for it.
inline bool read_request_id(const dds::SampleInfo& info, std::vector<std::uint8_t>& message, RequestId& id) {
  id.client = info.sample_identity.writer_guid();
  id.number = info.sample_identity.sequence_number();
  id.is_cyclone = is_of_cyclone(id.client);
  if (id.is_cyclone) {
    if (message.size() < id.header.size()) return false;
    std::memcpy(id.header.data(), message.data(), id.header.size());
    message.erase(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(id.header.size()));
    return true;
  }
  const Guid& replies = info.related_sample_identity.writer_guid();
  if (replies != Guid::unknown()) id.client = replies;
  return true;
}

/// A message after the header, of which the values keep their alignment: the header has 16 bytes.
inline messages::WireBuffer with_header(const CycloneHeader& header, const messages::WireBuffer& message) {
  messages::WireBuffer whole;
  whole.put_bytes(header.data(), header.size());
  whole.put_bytes(message.data(), message.size());
  return whole;
}

}  // namespace bubblesim::ros2
