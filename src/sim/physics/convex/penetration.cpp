// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/penetration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "physics/convex/gjk.hpp"

namespace bubblesim {
namespace {

constexpr int kMaxExpansions = 96;
constexpr double kConverged = 1e-9;     // of the shapes' reach
constexpr double kFlatSimplex = 1e-10;  // of the shapes' reach
constexpr double kPreferFace = 1e-3;    // relative depth by which a face may be deeper than the best direction
constexpr double kAsDeep = 1e-7;        // of the shapes' reach, likewise
constexpr double kCoresApart = 1e-9;    // of the shapes' reach; nearer cores give no direction

/// A polytope around the origin inside A - B, which grows to its boundary. Gino van den Bergen, 2001.
class ExpandingPolytope {
 public:
  ExpandingPolytope(const ConvexShape& a, const ConvexShape& b, const CoreDistance& start)
      : a_(a), b_(b), scale_(a.reach() + b.reach()) {
    points_.assign(start.simplex.begin(), start.simplex.begin() + start.count);
  }

  /// The outward normal of A - B where its boundary is nearest to the origin, with the point between the shapes there.
  std::optional<Penetration> expand() {
    if (!complete()) return {};
    for (int round = 0; round < kMaxExpansions; ++round) {
      const auto nearest = std::min_element(faces_.begin(), faces_.end(),
                                            [](const Face& x, const Face& y) { return x.distance < y.distance; });
      if (nearest == faces_.end() || !std::isfinite(nearest->distance)) return {};
      const Face face = *nearest;
      const DifferencePoint next = difference_point(a_, b_, face.normal);
      if (next.at.dot(face.normal) - face.distance <= kConverged * scale_) return result(face);
      if (!grow(next)) return result(face);
    }
    return {};
  }

 private:
  struct Face {
    std::array<std::size_t, 3> corners{};
    Vector3 normal;
    double distance = 0;
  };

  /// Adds points until the polytope has a volume.
  bool complete() {
    for (int i = 0; points_.size() < 4 && i < 12; ++i) {  // twice along each axis, forth and back
      try_point(Vector3::Unit(i % 3) * (i % 6 < 3 ? 1 : -1));
    }
    if (points_.size() < 4) {
      // Flat along the axes: search across what there is.
      if (points_.size() == 3) {
        const Vector3 normal = (points_[1].at - points_[0].at).cross(points_[2].at - points_[0].at).normalized();
        try_point(normal);
        if (points_.size() < 4) try_point(-normal);
      }
      if (points_.size() < 4) return false;
    }
    if (volume(points_[0].at, points_[1].at, points_[2].at, points_[3].at) < 0) std::swap(points_[2], points_[3]);
    // Counter-clockwise from outside when the fourth point lies on the side of the normal of the first three.
    for (const std::array<std::size_t, 3>& corners :
         {std::array<std::size_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      add_face(corners);
    }
    return true;
  }

  static double volume(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    return (b - a).cross(c - a).dot(d - a);
  }

  void try_point(const Vector3& direction) {
    const DifferencePoint next = difference_point(a_, b_, direction);
    const double least = kFlatSimplex * scale_;
    if (points_.empty()) {
      points_.push_back(next);
      return;
    }
    const Vector3 offset = next.at - points_[0].at;
    double extent = offset.norm();
    if (points_.size() == 2) extent = (points_[1].at - points_[0].at).normalized().cross(offset).norm();
    if (points_.size() == 3) {
      extent = std::abs((points_[1].at - points_[0].at).cross(points_[2].at - points_[0].at).normalized().dot(offset));
    }
    if (extent > least) points_.push_back(next);
  }

  void add_face(const std::array<std::size_t, 3>& corners) {
    const Vector3& first = points_[corners[0]].at;
    const Vector3 normal = (points_[corners[1]].at - first).cross(points_[corners[2]].at - first);
    const double size = normal.norm();
    Face face{corners, {}, std::numeric_limits<double>::infinity()};
    if (size > kFlatSimplex * kFlatSimplex * scale_ * scale_) {
      face.normal = normal / size;
      face.distance = std::max(first.dot(face.normal), 0.0);
    }
    faces_.push_back(face);
  }

  /// Replaces the faces that the point sees. False when it sees none.
  bool grow(const DifferencePoint& next) {
    const auto sees = [&](const Face& face) {
      return face.normal.dot(next.at - points_[face.corners[0]].at) > 1e-14 * scale_;
    };
    edges_.clear();
    std::vector<Face> kept;
    for (const Face& face : faces_) {
      if (!sees(face)) {
        kept.push_back(face);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) add_edge(face.corners[i], face.corners[(i + 1) % 3]);
    }
    if (edges_.empty()) return false;
    faces_ = std::move(kept);
    points_.push_back(next);
    for (const auto& [from, to] : edges_) add_face({from, to, points_.size() - 1});
    return true;
  }

  /// Edges between two faces that are removed go too.
  void add_edge(std::size_t from, std::size_t to) {
    const auto back = std::find(edges_.begin(), edges_.end(), std::pair(to, from));
    if (back != edges_.end()) {
      edges_.erase(back);
    } else {
      edges_.emplace_back(from, to);
    }
  }

  Penetration result(const Face& face) const {
    const DifferencePoint& p = points_[face.corners[0]];
    const DifferencePoint& q = points_[face.corners[1]];
    const DifferencePoint& r = points_[face.corners[2]];
    const Vector3 foot = face.normal * face.distance;
    const double whole = face.normal.dot((q.at - p.at).cross(r.at - p.at));
    const double v = face.normal.dot((foot - p.at).cross(r.at - p.at)) / whole;
    const double w = face.normal.dot((q.at - p.at).cross(foot - p.at)) / whole;
    const auto between = [&](const Vector3& x, const Vector3& y, const Vector3& z) -> Vector3 {
      return x * (1 - v - w) + y * v + z * w;
    };
    return {-face.normal, face.distance, (between(p.on_a, q.on_a, r.on_a) + between(p.on_b, q.on_b, r.on_b)) * 0.5};
  }

  const ConvexShape& a_;
  const ConvexShape& b_;
  double scale_;
  std::vector<DifferencePoint> points_;
  std::vector<Face> faces_;
  std::vector<std::pair<std::size_t, std::size_t>> edges_;
};

/// Keeps the normal of the nearest face of either shape if it is as deep: it does not change from substep to substep.
void prefer_face(const ConvexShape& a, const ConvexShape& b, Penetration& found) {
  thread_local Feature feature;
  const double most = found.depth * (1 + kPreferFace) + kAsDeep * (a.reach() + b.reach());
  for (const bool of_b : {true, false}) {
    const double side = of_b ? 1 : -1;
    (of_b ? b : a).feature(found.normal * side, feature);
    if (feature.corners.size() < 3) continue;
    const Vector3 normal = feature.normal * side;
    const double depth = depth_along(a, b, normal);
    if (depth > most) continue;
    found.normal = normal;
    found.depth = depth;
    return;
  }
}

/// Where no polytope was found, the best of some directions is taken.
Penetration try_directions(const ConvexShape& a, const ConvexShape& b) {
  thread_local Feature feature;
  std::vector<Vector3> directions = {(a.centre() - b.centre()).normalized()};
  for (const ConvexShape* shape : {&a, &b}) {
    for (const double sign : {1, -1}) {
      for (int axis = 0; axis < 3; ++axis) directions.push_back(shape->frame().rotation.col(axis) * sign);
    }
  }
  Penetration best;
  best.depth = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vector3& normal) {
    const double depth = normal.squaredNorm() > 0.5 ? depth_along(a, b, normal) : best.depth;
    if (depth < best.depth) best = {normal, depth, {}};
  };
  for (const Vector3& direction : directions) {
    consider(direction);
    b.feature(direction, feature);
    if (feature.corners.size() > 2) consider(feature.normal);
    a.feature(-direction, feature);
    if (feature.corners.size() > 2) consider(-feature.normal);
  }
  best.point = (a.support(-best.normal) + b.support(best.normal)) * 0.5;
  return best;
}

}  // namespace

double depth_along(const ConvexShape& a, const ConvexShape& b, const Vector3& normal) {
  return (b.support(normal) - a.support(-normal)).dot(normal) + a.rounding() + b.rounding();
}

std::optional<Penetration> penetration(const ConvexShape& a, const ConvexShape& b) {
  const double rounding = a.rounding() + b.rounding();
  const CoreDistance cores = core_distance(a, b, rounding);
  if (!cores.overlap && cores.distance > kCoresApart * (a.reach() + b.reach())) {
    if (cores.distance >= rounding) return {};
    const Vector3 normal = (cores.on_a - cores.on_b).normalized();
    const Vector3 on_a = cores.on_a - normal * a.rounding();
    const Vector3 on_b = cores.on_b + normal * b.rounding();
    return Penetration{normal, rounding - cores.distance, (on_a + on_b) * 0.5};
  }
  std::optional<Penetration> found = ExpandingPolytope(a, b, cores).expand();
  if (found) {
    const Vector3 offset = found->normal * ((b.rounding() - a.rounding()) / 2);
    found->point += offset;
    found->depth = depth_along(a, b, found->normal);
  } else {
    found = try_directions(a, b);
  }
  if (found->depth <= 0) return {};
  prefer_face(a, b, *found);
  return found;
}

}  // namespace bubblesim
