// SPDX-License-Identifier: BSD-3-Clause
// A packet of sixteen rays, the unit of Embree queries.
#pragma once

#include <array>
#include <cstddef>

#include "bubblesim/math.hpp"
#include "rays/embree.hpp"

namespace bubblesim::rays {

constexpr std::size_t kPacket = 16;
constexpr int kUsed = -1;  ///< in a mask; 0: ray not used

struct alignas(64) RayMask {
  int use[kPacket];
};

using PacketFloats = std::array<float, kPacket>;

/// Sets origin and direction of ray `i`.
inline void aim(RTCRay16& rays, std::size_t i, const Vector3& origin, const Vector3& direction) {
  rays.org_x[i] = static_cast<float>(origin.x());
  rays.org_y[i] = static_cast<float>(origin.y());
  rays.org_z[i] = static_cast<float>(origin.z());
  rays.dir_x[i] = static_cast<float>(direction.x());
  rays.dir_y[i] = static_cast<float>(direction.y());
  rays.dir_z[i] = static_cast<float>(direction.z());
}

/// Distances are multiples of each ray's direction, which need not have length 1.
struct RayPacket {
  RTCRayHit16 data{};
  RayMask mask;

  /// Sets origin and range (`near` to `far`) of the first `count` rays. The caller sets the directions.
  void start(const Vector3& origin, float near, float far, std::size_t count) {
    const auto x = static_cast<float>(origin.x());
    const auto y = static_cast<float>(origin.y());
    const auto z = static_cast<float>(origin.z());
    for (std::size_t i = 0; i < kPacket; ++i) {
      data.ray.org_x[i] = x;
      data.ray.org_y[i] = y;
      data.ray.org_z[i] = z;
      data.ray.tnear[i] = near;
      data.ray.time[i] = 0;
      data.ray.mask[i] = ~0U;
      data.ray.flags[i] = 0;
    }
    restart(far, count);
  }
  /// Forgets the hits of a packet that was traced; origins and near ends stay.
  void restart(float far, std::size_t count) {
    for (std::size_t i = 0; i < kPacket; ++i) {
      data.ray.tfar[i] = far;
      data.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      data.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      mask.use[i] = i < count ? kUsed : 0;
    }
  }
  bool hit(std::size_t i) const { return data.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; }
};

}  // namespace bubblesim::rays
