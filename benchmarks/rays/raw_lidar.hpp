// SPDX-License-Identifier: BSD-3-Clause
// A lidar by hand on Embree, with nothing around it: the limit that a simulator on Embree can reach.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "bubblesim/scene.hpp"

namespace bubblesim::benchmarks {

/// Boxes that stand still, boxes that move, and ground at z = 0.
class RawLidar {
 public:
  struct PlacedBox {
    Box box;
    Pose pose;
  };

  RawLidar(const LidarDescription& lidar, const std::vector<PlacedBox>& still, const std::vector<PlacedBox>& moving);
  ~RawLidar();
  RawLidar(const RawLidar&) = delete;
  RawLidar& operator=(const RawLidar&) = delete;

  /// Moves the moving boxes, traces a turn from `sensor`; the ranges are of use until the next one.
  const std::vector<float>& scan(const Pose& sensor, const std::vector<Pose>& moving);

 private:
  RTCDevice device_;
  RTCScene still_;
  RTCScene moving_;
  std::vector<RTCGeometry> instances_;
  std::size_t count_ = 0;
  float max_range_;
  std::vector<float> x_, y_, z_;  // directions in the sensor's frame, padded to whole packets
  std::vector<float> ranges_;
};

}  // namespace bubblesim::benchmarks
