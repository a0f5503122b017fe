// SPDX-License-Identifier: BSD-3-Clause
// The volume of a convex hull to which points are added one by one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// For many small hulls: takes a fraction of the time of convex_hull(), which has the corners and faces of one. Points
/// count as if they were up to 1e-5 of the size beside their place.
class GrowingHull {
 public:
  /// `size`: of the box around all points, m.
  explicit GrowingHull(double size) : size_(size) {}

  void add(const Vector3& given);
  /// m^3; 0 while the points are in a plane.
  double volume() const;

 private:
  using Corner = std::uint32_t;
  using Face = std::array<Corner, 3>;  // counter-clockwise from outside

  Vector3 joggled(const Vector3& point);
  void wait(const Vector3& point);
  void start();
  void insert(const Vector3& point);
  void add_face(Corner a, Corner b, Corner c);

  double size_;
  std::uint32_t random_ = 0;
  std::vector<Vector3> corners_;
  std::vector<Face> faces_;
  std::array<std::vector<double>, 4> planes_;  // of the faces: components of their normals outwards, heights
  std::vector<Vector3> waiting_;               // until four points have a volume
  std::array<std::size_t, 4> first_{};         // of the waiting points, those that span
  std::size_t spanning_ = 0;
  // Working memory:
  std::vector<double> above_;  // height of a point above the faces
  std::vector<std::size_t> seen_;
  std::vector<std::pair<Corner, Corner>> edges_;
};

}  // namespace bubblesim
