// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace bubblesim {
namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles

}  // namespace

TriangleTree::TriangleTree(const std::vector<double>& coordinates, const std::vector<std::uint32_t>& indices)
    : indices_(indices), order_(indices.size() / 3) {
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    corners_.push_back({coordinates[i], coordinates[i + 1], coordinates[i + 2]});
  }
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.emplace_back();
  if (!order_.empty()) build(0, 0, static_cast<std::uint32_t>(order_.size()));
  connect();
  find_plain();
}

std::array<Vector3, 3> TriangleTree::corners(std::uint32_t triangle) const {
  const std::size_t first = 3 * static_cast<std::size_t>(triangle);
  return {corners_[indices_[first]], corners_[indices_[first + 1]], corners_[indices_[first + 2]]};
}

Bounds TriangleTree::bounds_of(std::uint32_t triangle) const {
  Bounds bounds;
  for (const Vector3& corner : corners(triangle)) bounds.extend(corner);
  return bounds;
}

void TriangleTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Bounds bounds;
  for (std::uint32_t i = first; i < first + count; ++i) bounds.extend(bounds_of(order_[i]));
  nodes_[node].bounds = bounds;
  if (count <= kLeaf) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  Eigen::Index axis = 0;
  bounds.sizes().maxCoeff(&axis);
  const auto middle = [&](std::uint32_t triangle) {
    const std::array<Vector3, 3> at = corners(triangle);
    return at[0][axis] + at[1][axis] + at[2][axis];
  };
  const auto begin = order_.begin() + first;
  const std::uint32_t half = count / 2;
  // Triangles of equal height are ordered by number: the tree must not depend on the library.
  std::nth_element(begin, begin + half, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return std::pair(middle(a), a) < std::pair(middle(b), b); });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, first, half);
  build(children + 1, first + half, count - half);
}

void TriangleTree::connect() {
  struct Side {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t at;  // in neighbours_
  };
  std::vector<Side> sides;
  sides.reserve(indices_.size());
  for (std::uint32_t i = 0; i < indices_.size(); ++i) {
    const auto [low, high] = std::minmax(indices_[i], indices_[i % 3 == 2 ? i - 2 : i + 1]);
    sides.push_back({low, high, i});
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::tie(a.low, a.high, a.at) < std::tie(b.low, b.high, b.at); });
  neighbours_.assign(indices_.size(), kNone);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (end == i + 2) {
      neighbours_[sides[i].at] = sides[i + 1].at / 3;
      neighbours_[sides[i + 1].at] = sides[i].at / 3;
    }
    i = end;
  }
}

Vector3 TriangleTree::normal_of(std::uint32_t triangle) const {
  const std::array<Vector3, 3> at = corners(triangle);
  return (at[1] - at[0]).cross(at[2] - at[0]).normalized();
}

void TriangleTree::find_plain() {
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    const std::array<Vector3, 3> at = corners(i);
    const Vector3 normal = normal_of(i);
    std::uint8_t plain = 3;
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const std::uint32_t other = across_edge(i, edge);
      if (other == kNone) {
        plain = 0;
        break;
      }
      const Vector3 beyond = normal_of(other);
      const Vector3 out = (at[(edge + 1) % 3] - at[edge]).normalized().cross(normal);
      const double turn = std::atan2(beyond.dot(out), beyond.dot(normal));
      if (!(turn < kSharp)) plain &= 2U;
      if (!(-turn < kSharp)) plain &= 1U;
    }
    plain_.push_back(plain);
  }
}

void TriangleTree::near(const Bounds& box, std::vector<std::uint32_t>& triangles) const {
  if (order_.empty()) return;
  std::array<std::uint32_t, 64> waiting{};  // halves: as deep as the logarithm of the number of triangles
  std::size_t count = 1;
  while (count > 0) {
    const Node& node = nodes_[waiting[--count]];
    if (!node.bounds.intersects(box)) continue;
    if (node.count == 0) {
      waiting[count++] = node.first + 1;
      waiting[count++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (bounds_of(order_[i]).intersects(box)) triangles.push_back(order_[i]);
    }
  }
}

}  // namespace bubblesim
