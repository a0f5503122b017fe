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
      if (dot(next.at, face.normal) - face.distance <= kConverged * scale_) return result(face);
      if (!grow(next)) return result(face);
    }
    return {};
  }

 private:
  struct Face {
    std::array<std::size_t, 3> corners{};
    Vec3 normal;
    double distance = 0;
  };

  /// Adds points until the polytope has a volume.
  bool complete() {
    const std::array<Vec3, 6> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    for (std::size_t i = 0; points_.size() < 4 && i < 2 * axes.size(); ++i) try_point(axes[i % axes.size()]);
    if (points_.size() < 4) {
      // Flat along the axes: search across what there is.
      if (points_.size() == 3) {
        const Vec3 normal = unit(cross(points_[1].at - points_[0].at, points_[2].at - points_[0].at));
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

  static double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return dot(cross(b - a, c - a), d - a);
  }

  void try_point(const Vec3& direction) {
    const DifferencePoint next = difference_point(a_, b_, direction);
    const double least = kFlatSimplex * scale_;
    if (points_.empty()) {
      points_.push_back(next);
      return;
    }
    const Vec3 offset = next.at - points_[0].at;
    double extent = length(offset);
    if (points_.size() == 2) extent = length(cross(unit(points_[1].at - points_[0].at), offset));
    if (points_.size() == 3) {
      extent = std::abs(dot(unit(cross(points_[1].at - points_[0].at, points_[2].at - points_[0].at)), offset));
    }
    if (extent > least) points_.push_back(next);
  }

  void add_face(const std::array<std::size_t, 3>& corners) {
    const Vec3& first = points_[corners[0]].at;
    const Vec3 normal = cross(points_[corners[1]].at - first, points_[corners[2]].at - first);
    const double size = length(normal);
    Face face{corners, {}, std::numeric_limits<double>::infinity()};
    if (size > kFlatSimplex * kFlatSimplex * scale_ * scale_) {
      face.normal = normal * (1 / size);
      face.distance = std::max(dot(first, face.normal), 0.0);
    }
    faces_.push_back(face);
  }

  /// Replaces the faces that the point sees. False when it sees none.
  bool grow(const DifferencePoint& next) {
    const auto sees = [&](const Face& face) {
      return dot(face.normal, next.at - points_[face.corners[0]].at) > 1e-14 * scale_;
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
    const Vec3 foot = face.normal * face.distance;
    const double whole = dot(face.normal, cross(q.at - p.at, r.at - p.at));
    const double v = dot(face.normal, cross(foot - p.at, r.at - p.at)) / whole;
    const double w = dot(face.normal, cross(q.at - p.at, foot - p.at)) / whole;
    const auto between = [&](const Vec3& x, const Vec3& y, const Vec3& z) { return x * (1 - v - w) + y * v + z * w; };
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
    const Vec3 normal = feature.normal * side;
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
  std::vector<Vec3> directions = {unit(a.centre() - b.centre())};
  for (const ConvexShape* shape : {&a, &b}) {
    const Transform& frame = shape->frame();
    directions.insert(directions.end(), {frame.x, frame.y, frame.z, -frame.x, -frame.y, -frame.z});
  }
  Penetration best;
  best.depth = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& normal) {
    const double depth = dot(normal, normal) > 0.5 ? depth_along(a, b, normal) : best.depth;
    if (depth < best.depth) best = {normal, depth, {}};
  };
  for (const Vec3& direction : directions) {
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

double depth_along(const ConvexShape& a, const ConvexShape& b, const Vec3& normal) {
  return dot(b.support(normal) - a.support(-normal), normal) + a.rounding() + b.rounding();
}

std::optional<Penetration> penetration(const ConvexShape& a, const ConvexShape& b) {
  const double rounding = a.rounding() + b.rounding();
  const CoreDistance cores = core_distance(a, b, rounding);
  if (!cores.overlap && cores.distance > kCoresApart * (a.reach() + b.reach())) {
    if (cores.distance >= rounding) return {};
    const Vec3 normal = unit(cores.on_a - cores.on_b);
    const Vec3 on_a = cores.on_a - normal * a.rounding();
    const Vec3 on_b = cores.on_b + normal * b.rounding();
    return Penetration{normal, rounding - cores.distance, (on_a + on_b) * 0.5};
  }
  std::optional<Penetration> found = ExpandingPolytope(a, b, cores).expand();
  if (found) {
    const Vec3 offset = found->normal * ((b.rounding() - a.rounding()) / 2);
    found->point = found->point + offset;
    found->depth = depth_along(a, b, found->normal);
  } else {
    found = try_directions(a, b);
  }
  if (found->depth <= 0) return {};
  prefer_face(a, b, *found);
  return found;
}

}  // namespace bubblesim
