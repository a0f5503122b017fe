// SPDX-License-Identifier: BSD-3-Clause
// The rays of a traced packet, grouped by the shape that they hit: mostly one or two shapes.
#pragma once

#include <array>
#include <cstddef>

#include "rays/packet_math.hpp"
#include "rays/ray_packet.hpp"

namespace bubblesim::rays {

struct HitGroup {
  std::size_t ray;  ///< one of them
  RayMask members;
};

class HitGroups {
 public:
  explicit HitGroups(const RayPacket& packet) : all_hit_(find_hits(packet.data.hit, packet.mask, hits_)) {
    RayMask left = hits_;
    for (std::size_t i = 0; i < kPacket; ++i) {
      if (left.use[i] == 0) continue;
      HitGroup& group = groups_[count_++];
      group.ray = i;
      if (!take_same(packet.data.hit, i, left, group.members)) return;
    }
  }

  /// The rays that hit something.
  const RayMask& hits() const { return hits_; }
  bool all_hit() const { return all_hit_; }
  const HitGroup* begin() const { return groups_.data(); }
  const HitGroup* end() const { return groups_.data() + count_; }

 private:
  RayMask hits_;
  bool all_hit_;
  std::size_t count_ = 0;
  std::array<HitGroup, kPacket> groups_;
};

}  // namespace bubblesim::rays
