// SPDX-License-Identifier: BSD-3-Clause
// Finds the triangles of a mesh near a box, and their neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bubblesim/math.hpp"

namespace bubblesim {

using Bounds = Eigen::AlignedBox3d;  // starts empty

/// A hierarchy of boxes over triangles. Immutable.
class TriangleTree {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  /// Corners in m, three indices per triangle; equal corners must have equal indices.
  TriangleTree(const std::vector<double>& coordinates, const std::vector<std::uint32_t>& indices);

  /// Adds the triangles whose boxes meet `box`, in a fixed order.
  void near(const Bounds& box, std::vector<std::uint32_t>& triangles) const;

  std::array<Vector3, 3> corners(std::uint32_t triangle) const;
  /// The triangle across the edge from corner i to the next, or kNone at a border and at an edge of more than two.
  std::uint32_t across_edge(std::uint32_t triangle, std::size_t i) const { return neighbours_[3UL * triangle + i]; }
  /// Whether the surface has no edge at the triangle, seen from the side of its normal or (`behind`) from the other:
  /// across each side it goes on, and does not turn away by more than kSharp.
  bool is_plain(std::uint32_t triangle, bool behind) const { return (plain_[triangle] & (behind ? 2U : 1U)) != 0; }

  static constexpr double kSharp = 0.02;  ///< angle at an edge in rad, below which the surface is smooth

 private:
  struct Node {
    Bounds bounds;
    std::uint32_t first = 0;  // of the triangles of a leaf, in order_; of two children otherwise
    std::uint32_t count = 0;  // 0: not a leaf
  };

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  void connect();
  void find_plain();
  Vector3 normal_of(std::uint32_t triangle) const;
  Bounds bounds_of(std::uint32_t triangle) const;

  std::vector<Vector3> corners_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint8_t> plain_;  // by triangle: 1 in front, 2 behind
  std::vector<Node> nodes_;
};

}  // namespace bubblesim
