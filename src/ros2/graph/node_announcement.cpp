// SPDX-License-Identifier: BSD-3-Clause
#include "graph/node_announcement.hpp"

#include <cstring>
#include <utility>

namespace bubblesim::ros2 {
namespace {

const TopicName kTopic{
    "ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
    "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"};  // of rmw_dds_common in Jazzy
constexpr std::size_t kPrefixSize = 12;
constexpr std::size_t kEntitySize = 4;

messages::Qos announcement_qos() {
  messages::Qos qos;
  qos.depth = 1;
  qos.transient_local = true;
  return qos;
}

}  // namespace

NodeAnnouncement::NodeAnnouncement(Participant& participant, std::string node_namespace, std::string node,
                                   std::size_t gid_size)
    : participant_(participant),
      space_(std::move(node_namespace)),
      node_(std::move(node)),
      gid_size_(gid_size),
      writer_(participant, kTopic, announcement_qos(), nullptr, false) {}

void NodeAnnouncement::update() {
  if (participant_.revision() == announced_) return;
  const NodeEndpoints endpoints = participant_.endpoints();
  announced_ = endpoints.revision;
  messages::WireBuffer message;
  message.begin(messages::Layout::kCdr);
  put(message, participant_.guid());
  message.put(std::uint32_t{1});  // nodes
  message.put_string(space_);
  message.put_string(node_);
  put(message, endpoints.readers);
  put(message, endpoints.writers);
  write(*writer_, message);
}

void NodeAnnouncement::put(messages::WireBuffer& message, const Guid& guid) const {
  std::uint8_t* place = message.extend(gid_size_);
  std::memset(place, 0, gid_size_);
  std::memcpy(place, guid.guidPrefix.value, kPrefixSize);
  std::memcpy(place + kPrefixSize, guid.entityId.value, kEntitySize);
}

void NodeAnnouncement::put(messages::WireBuffer& message, const std::set<Guid>& guids) const {
  message.put(static_cast<std::uint32_t>(guids.size()));
  for (const Guid& guid : guids) put(message, guid);
}

}  // namespace bubblesim::ros2
