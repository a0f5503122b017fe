// SPDX-License-Identifier: BSD-3-Clause
// The incremental algorithm: de Berg et al., Computational Geometry, 3rd edition, 11.2, without a conflict graph.
#include "meshes/growing_hull.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

// Of the size, by which points are moved at random, so that no four of them are in a plane and rounding decides
// nothing: Barber et al., The Quickhull Algorithm for Convex Hulls, 1996, section 5.
constexpr double kJoggle = 1e-5;
constexpr double kSpans = 1e-3;  // of the size, beyond the line or plane of the first points

}  // namespace

Vector3 GrowingHull::joggled(const Vector3& point) {
  Vector3 moved = point;
  for (Eigen::Index i = 0; i < 3; ++i) {
    random_ = 1664525U * random_ + 1013904223U;
    moved[i] += kJoggle * size_ * (static_cast<double>(random_) / 0x80000000U - 1);
  }
  return moved;
}

void GrowingHull::add(const Vector3& given) {
  const Vector3 point = joggled(given);
  if (faces_.empty()) {
    wait(point);
  } else {
    insert(point);
  }
}

/// Keeps a point until the first ones span a tetrahedron.
void GrowingHull::wait(const Vector3& point) {
  waiting_.push_back(point);
  const auto at = [&](std::size_t i) -> const Vector3& { return waiting_[first_[i]]; };
  double beyond = size_;
  if (spanning_ == 1) beyond = (point - at(0)).norm();
  if (spanning_ == 2) beyond = (point - at(0)).cross((at(1) - at(0)).normalized()).norm();
  if (spanning_ == 3) beyond = std::abs((point - at(0)).dot((at(1) - at(0)).cross(at(2) - at(0)).normalized()));
  if (beyond <= kSpans * size_) return;
  first_[spanning_++] = waiting_.size() - 1;
  if (spanning_ == 4) start();
}

void GrowingHull::start() {
  for (const std::size_t i : first_) corners_.push_back(waiting_[i]);
  const Vector3 normal = (corners_[1] - corners_[0]).cross(corners_[2] - corners_[0]);
  if (normal.dot(corners_[3] - corners_[0]) > 0) std::swap(corners_[1], corners_[2]);
  add_face(0, 1, 2);
  add_face(0, 3, 1);
  add_face(1, 3, 2);
  add_face(2, 3, 0);
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    if (std::find(first_.begin(), first_.end(), i) == first_.end()) insert(waiting_[i]);
  }
  waiting_.clear();
}

void GrowingHull::add_face(Corner a, Corner b, Corner c) {
  faces_.push_back({a, b, c});
  const Vector3 normal = (corners_[b] - corners_[a]).cross(corners_[c] - corners_[a]).normalized();
  for (Eigen::Index i = 0; i < 3; ++i) planes_[static_cast<std::size_t>(i)].push_back(normal[i]);
  planes_[3].push_back(normal.dot(corners_[a]));
}

/// Replaces the faces that the point sees by faces from it to their rim.
void GrowingHull::insert(const Vector3& point) {
  if (faces_.size() > 2 * corners_.size()) return;  // no sphere any more, for all care: its volume must do
  seen_.clear();
  const std::size_t count = faces_.size();
  above_.resize(count);
  const auto& [x, y, z, height] = planes_;
  for (std::size_t i = 0; i < count; ++i) {
    above_[i] = x[i] * point.x() + y[i] * point.y() + z[i] * point.z() - height[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (above_[i] > 0) seen_.push_back(i);
  }
  if (seen_.empty()) return;
  edges_.clear();
  for (const std::size_t i : seen_) {
    const auto& [a, b, c] = faces_[i];
    edges_.insert(edges_.end(), {{a, b}, {b, c}, {c, a}});
  }
  std::sort(edges_.begin(), edges_.end());
  for (auto i = seen_.rbegin(); i != seen_.rend(); ++i) {
    faces_[*i] = faces_.back();
    faces_.pop_back();
    for (std::vector<double>& values : planes_) {
      values[*i] = values.back();
      values.pop_back();
    }
  }
  const auto own = static_cast<Corner>(corners_.size());
  corners_.push_back(point);
  for (const auto& [from, to] : edges_) {
    if (!std::binary_search(edges_.begin(), edges_.end(), std::pair(to, from))) add_face(from, to, own);
  }
}

double GrowingHull::volume() const {
  double sixfold = 0;
  for (const Face& face : faces_) {
    const Vector3& from = corners_.front();
    const Vector3 a = corners_[face[0]] - from;
    const Vector3 b = corners_[face[1]] - from;
    const Vector3 c = corners_[face[2]] - from;
    sixfold += a.dot(b.cross(c));
  }
  return sixfold / 6;
}

}  // namespace bubblesim
