// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bubblesim {
namespace {

constexpr double kGrazing = 0.1;     // cosine between a face and the normal below which the face has no height over it
constexpr double kDeepest = 0.5;     // of the depth: points that are all shallower miss the deepest one
constexpr double kSamePlace = 1e-6;  // of the shapes' reach, between two points

/// Cuts off what lies outside the prism of a polygon along a direction (Sutherland and Hodgman, 1974).
void clip(const Feature& polygon, const Vector3& along, std::vector<Vector3>& subject) {
  thread_local std::vector<Vector3> before;
  const double side = polygon.normal.dot(along) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < polygon.corners.size() && !subject.empty(); ++i) {
    const Vector3& from = polygon.corners[i];
    const Vector3& to = polygon.corners[(i + 1) % polygon.corners.size()];
    const Vector3 inward = along.cross(to - from) * side;
    const auto height = [&](const Vector3& point) { return (point - from).dot(inward); };
    before.swap(subject);
    subject.clear();
    if (before.size() == 1) {
      if (height(before[0]) >= 0) subject.push_back(before[0]);
      continue;
    }
    const std::size_t edges = before.size() == 2 ? 1 : before.size();
    for (std::size_t j = 0; j < edges; ++j) {
      const Vector3& start = before[j];
      const Vector3& end = before[(j + 1) % before.size()];
      const double h = height(start);
      const double k = height(end);
      if (h >= 0) subject.push_back(start);
      if ((h >= 0) != (k >= 0)) subject.push_back(start + (end - start) * (h / (h - k)));
      if (edges == 1 && k >= 0) subject.push_back(end);
    }
  }
}

}  // namespace

double add_area(const ConvexShape& a, const ConvexShape& b, const Vector3& normal, double most,
                std::vector<ManifoldPoint>& points) {
  thread_local Feature of_a;
  thread_local Feature of_b;
  a.feature(-normal, of_a);
  b.feature(normal, of_b);
  const auto facing = [&](const Feature& feature) {
    return feature.corners.size() < 3 ? 0 : std::abs(feature.normal.dot(normal));
  };
  // The polygon that faces the normal better is the prism; heights are measured from its plane.
  const bool a_clips = facing(of_a) > facing(of_b);
  const Feature& prism = a_clips ? of_a : of_b;
  std::vector<Vector3>& subject = a_clips ? of_b.corners : of_a.corners;
  const std::size_t first = points.size();
  double deepest = 0;
  if (facing(prism) > kGrazing) {
    clip(prism, normal, subject);
    const double slope = 1 / normal.dot(prism.normal);
    const double same = kSamePlace * (a.reach() + b.reach());
    for (const Vector3& point : subject) {
      const double to_plane = (prism.corners[0] - point).dot(prism.normal) * slope;
      const double depth = std::min(a_clips ? -to_plane : to_plane, most);
      if (depth <= 0) continue;
      const Vector3 at = point + normal * (to_plane / 2);
      const bool repeated = std::any_of(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(),
                                        [&](const ManifoldPoint& p) { return (p.at - at).norm() < same; });
      if (!repeated) points.push_back({at, normal, depth});
      deepest = std::max(deepest, depth);
    }
  }
  return deepest;
}

void add_manifold(const ConvexShape& a, const ConvexShape& b, const Penetration& overlap,
                  std::vector<ManifoldPoint>& points) {
  const double deepest = add_area(a, b, overlap.normal, overlap.depth, points);
  if (deepest < kDeepest * overlap.depth) points.push_back({overlap.point, overlap.normal, overlap.depth});
}

}  // namespace bubblesim
