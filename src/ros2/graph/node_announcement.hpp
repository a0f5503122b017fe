// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "dds/participant.hpp"

namespace bubblesim::ros2 {

/// Announces on ros_discovery_info which readers and writers belong to this node: DDS knows endpoints, but no nodes.
class NodeAnnouncement {
 public:
  /// `gid_size`: see Environment.
  NodeAnnouncement(Participant& participant, std::string node_namespace, std::string node, std::size_t gid_size);

  /// Announces the endpoints if they have changed since the last call.
  void update();

 private:
  void put(messages::WireBuffer& message, const Guid& guid) const;
  void put(messages::WireBuffer& message, const std::set<Guid>& guids) const;

  Participant& participant_;
  const std::string space_;
  const std::string node_;
  const std::size_t gid_size_;
  Writer writer_;
  int announced_ = -1;  // the revision of the endpoints
};

}  // namespace bubblesim::ros2
