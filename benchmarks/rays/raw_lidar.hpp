// SPDX-License-Identifier: BSD-3-Clause
// A lidar implemented directly with Embree: the upper limit for a simulator based on Embree.
#pragma once

#include <vector>

#include "bubblesim/scene.hpp"
#include "rays/embree.hpp"

namespace bubblesim::benchmarks {

/// Static boxes, moving boxes, and ground at z = 0.
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

  /// Moves the moving boxes and traces a scan from `sensor`; the ranges are valid until the next scan.
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
