// SPDX-License-Identifier: BSD-3-Clause
#include "rays/face_lanes.hpp"

#include <limits>

#include "scene/simd.hpp"

namespace bubblesim::rays {

BUBBLESIM_SIMD void find_nearest_faces(const ImageFace* all, const std::uint16_t* faces, std::size_t count,
                                       const NearnessLimits& limits, double up, const double* left,
                                       NearestFaces& seen) {
  const double least = limits.least;
  const double most = limits.most;
  alignas(64) double across[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    across[i] = left[i];
    seen.nearness[i] = least;
    seen.face[i] = -1;
  }
  for (std::size_t number = 0; number < count; ++number) {
    const ImageFace& face = all[faces[number]];
    double start[kSides];
    double slope[kSides];
    for (std::size_t side = 0; side < kSides; ++side) {
      start[side] = face.sides[side].constant + up * face.sides[side].y;
      slope[side] = face.sides[side].x;
    }
    const double start_near = face.nearness.constant + up * face.nearness.y;
    const double slope_near = face.nearness.x;
    const auto index = static_cast<double>(number);
    for (std::size_t i = 0; i < kPacket; ++i) {
      const double a = start[0] + slope[0] * across[i];
      const double b = start[1] + slope[1] * across[i];
      const double c = start[2] + slope[2] * across[i];
      const double d = start[3] + slope[3] * across[i];
      const double ab = a < b ? a : b;
      const double cd = c < d ? c : d;
      const double inner = ab < cd ? ab : cd;
      const double near = start_near + slope_near * across[i];
      const bool nearer = (inner >= 0) & (near > seen.nearness[i]) & (near <= most);
      seen.nearness[i] = nearer ? near : seen.nearness[i];
      seen.face[i] = nearer ? index : seen.face[i];
    }
  }
}

BUBBLESIM_SIMD void keep_depths(const NearestFaces& seen, float none, float* depths) {
  alignas(64) float depth[kPacket];
  alignas(64) float face[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    depth[i] = static_cast<float>(1 / seen.nearness[i]);
    face[i] = static_cast<float>(seen.face[i]);
  }
  for (std::size_t i = 0; i < kPacket; ++i) depths[i] = face[i] >= 0 ? depth[i] : none;
}

BUBBLESIM_SIMD void place_in_light(const LightFrame& frame, const RTCRay16& rays, LightPlaces& places) {
  double x[kPacket], y[kPacket], z[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) {
    x[i] = static_cast<double>(rays.org_x[i]) - frame.middle[0];
    y[i] = static_cast<double>(rays.org_y[i]) - frame.middle[1];
    z[i] = static_cast<double>(rays.org_z[i]) - frame.middle[2];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = frame.axes[axis][0];
    const double b = frame.axes[axis][1];
    const double c = frame.axes[axis][2];
    for (std::size_t i = 0; i < kPacket; ++i) places.along[axis][i] = a * x[i] + b * y[i] + c * z[i];
  }
}

namespace {

// Whole numbers have least and greatest values that are found sixteen at a time.
constexpr double kPerMetre = 1e3;
constexpr double kMetresPer = 1e-3;
constexpr double kFarthest = 1e9;  // mm

BUBBLESIM_SIMD void to_millimetres(const double* values, int* whole) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    const double value = values[i] * kPerMetre;
    const double kept = value > -kFarthest ? value : -kFarthest;
    whole[i] = static_cast<int>(kept < kFarthest ? kept : kFarthest);
  }
}

BUBBLESIM_SIMD void range_of(const int* values, const int* use, int* least, int* most) {
  int low = std::numeric_limits<int>::max();
  int high = std::numeric_limits<int>::min();
  for (std::size_t i = 0; i < kPacket; ++i) {
    const int if_low = use[i] != 0 ? values[i] : std::numeric_limits<int>::max();
    const int if_high = use[i] != 0 ? values[i] : std::numeric_limits<int>::min();
    low = if_low < low ? if_low : low;
    high = if_high > high ? if_high : high;
  }
  *least = low;
  *most = high;
}

}  // namespace

LightBlock block_around(const LightPlaces& places, const RayMask& mask) {
  LightBlock block;
  alignas(64) int whole[kPacket];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int least = 0;
    int most = 0;
    to_millimetres(places.along[axis], whole);
    range_of(whole, mask.use, &least, &most);
    block.low[axis] = (least - 1.0) * kMetresPer;
    block.high[axis] = (most + 1.0) * kMetresPer;
  }
  return block;
}

namespace {

/// A function of its own: a compiler that saw the loop over the faces would vectorize that one.
BUBBLESIM_SIMD void mark_below(const LightFace& face, const LightPlaces& places, double* below) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    const double x = places.along[0][i];
    const double y = places.along[1][i];
    const double a = face.sides[0].constant + face.sides[0].x * x + face.sides[0].y * y;
    const double b = face.sides[1].constant + face.sides[1].x * x + face.sides[1].y * y;
    const double c = face.sides[2].constant + face.sides[2].x * x + face.sides[2].y * y;
    const double d = face.sides[3].constant + face.sides[3].x * x + face.sides[3].y * y;
    const double ab = a < b ? a : b;
    const double cd = c < d ? c : d;
    const double inner = ab < cd ? ab : cd;
    const double height = face.height.constant + face.height.x * x + face.height.y * y;
    const bool is_below = (inner >= 0) & (height > places.along[2][i]);
    below[i] = is_below ? 1 : below[i];
  }
}

BUBBLESIM_SIMD void end_marked(const double* below, const int* use, float* ends) {
  alignas(64) float marked[kPacket];
  for (std::size_t i = 0; i < kPacket; ++i) marked[i] = static_cast<float>(below[i]);
  for (std::size_t i = 0; i < kPacket; ++i) {
    const bool ended = (marked[i] > 0) & (use[i] != 0);
    ends[i] = ended ? -std::numeric_limits<float>::infinity() : ends[i];
  }
}

}  // namespace

void shade_below(const LightFace* all, const std::uint16_t* faces, std::size_t count, const LightPlaces& places,
                 const RayMask& mask, RTCRay16& rays) {
  alignas(64) double below[kPacket] = {};
  for (std::size_t number = 0; number < count; ++number) mark_below(all[faces[number]], places, below);
  end_marked(below, mask.use, rays.tfar);
}

}  // namespace bubblesim::rays
