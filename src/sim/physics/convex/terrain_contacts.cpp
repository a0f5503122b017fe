// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/terrain_contacts.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace bubblesim {
namespace {

constexpr double kOneCorner = 1e-6;       // of the triangle's reach: corners that are as far in a direction
constexpr double kAngleTolerance = 0.02;  // rad
constexpr double kMostLifted = 0.25;      // of the shape's reach, by which the face may push instead of an edge

struct NearTriangle {
  std::uint32_t number = 0;
  std::array<Vector3, 3> corners;  // in the world
  Vector3 normal;                  // to the side of the shape
  double side = 1;                 // -1: against the order of the corners
};

Vector3 plain_normal(const std::array<Vector3, 3>& at) { return (at[1] - at[0]).cross(at[2] - at[0]).normalized(); }

enum class Verdict { kKeep, kUseFace, kLeaveToNeighbour };

class Terrain {
 public:
  Terrain(const TriangleTree& tree, const Transform& mesh) : tree_(tree), mesh_(mesh) {}

  std::array<Vector3, 3> placed(std::uint32_t triangle) const {
    std::array<Vector3, 3> at = tree_.corners(triangle);
    for (Vector3& corner : at) corner = mesh_ * corner;
    return at;
  }

  /// Whether a normal is possible at the corners of the triangle that are farthest along it.
  Verdict classify(const NearTriangle& triangle, const Vector3& normal) const {
    std::array<double, 3> reach{};
    for (std::size_t i = 0; i < 3; ++i) reach[i] = triangle.corners[i].dot(normal);
    const double most = std::max({reach[0], reach[1], reach[2]});
    const double size =
        (triangle.corners[1] - triangle.corners[0]).norm() + (triangle.corners[2] - triangle.corners[0]).norm();
    std::array<bool, 3> touches{};
    for (std::size_t i = 0; i < 3; ++i) touches[i] = most - reach[i] < kOneCorner * size;
    if (touches[0] && touches[1] && touches[2]) return Verdict::kKeep;
    Verdict verdict = Verdict::kKeep;
    const bool on_edge = touches[0] + touches[1] + touches[2] == 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool both = touches[i] && touches[(i + 1) % 3];
      const bool either = touches[i] || touches[(i + 1) % 3];
      if (on_edge ? !both : !either) continue;
      const Verdict here = classify_edge(triangle, i, normal);
      if (here == Verdict::kUseFace) return here;
      if (here == Verdict::kLeaveToNeighbour) verdict = here;
    }
    return verdict;
  }

 private:
  Verdict classify_edge(const NearTriangle& triangle, std::size_t i, const Vector3& normal) const {
    const std::uint32_t other = tree_.across_edge(triangle.number, i);
    if (other == TriangleTree::kNone) return Verdict::kKeep;
    const Vector3 edge = (triangle.corners[(i + 1) % 3] - triangle.corners[i]).normalized();
    const Vector3 out = edge.cross(triangle.normal) * triangle.side;
    // Angles about the edge, from the normal of the triangle towards its neighbour.
    const Vector3 beyond = plain_normal(placed(other)) * triangle.side;
    const auto angle = [&](const Vector3& direction) {
      return std::atan2(direction.dot(out), direction.dot(triangle.normal));
    };
    const double limit = angle(beyond);
    if (limit < TriangleTree::kSharp)
      return angle(normal) <= kAngleTolerance && angle(normal) > -M_PI / 2 && on_face(triangle, normal)
                 ? Verdict::kKeep
                 : Verdict::kUseFace;
    if (angle(normal) > limit + kAngleTolerance) return Verdict::kLeaveToNeighbour;
    return Verdict::kKeep;
  }

  static bool on_face(const NearTriangle& triangle, const Vector3& normal) {
    return triangle.normal.dot(normal) > std::cos(kAngleTolerance);
  }

  const TriangleTree& tree_;
  const Transform& mesh_;
};

/// The overlap of a shape with a triangle, along a normal that the surface around it allows.
std::optional<Penetration> allowed_overlap(const ConvexShape& shape, const ConvexShape& flat, const Terrain& terrain,
                                           const NearTriangle& triangle) {
  std::optional<Penetration> found = penetration(shape, flat);
  if (!found) return found;
  const Verdict verdict = found->normal.dot(triangle.normal) < -kAngleTolerance
                              ? Verdict::kUseFace  // through the surface
                              : terrain.classify(triangle, found->normal);
  if (verdict == Verdict::kKeep) return found;
  if (verdict == Verdict::kLeaveToNeighbour) return {};
  const double depth = depth_along(shape, flat, triangle.normal);
  if (depth > found->depth + kMostLifted * shape.reach()) return {};
  return Penetration{triangle.normal, depth, found->point};
}

/// Whether the shape is beyond a side of the triangle.
bool is_beside(const ConvexShape& shape, const NearTriangle& triangle) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& from = triangle.corners[i];
    const Vector3 out = (triangle.corners[(i + 1) % 3] - from).cross(triangle.normal) * triangle.side;
    if ((shape.support(-out) - from).dot(out) > shape.rounding() * out.norm()) return true;
  }
  return false;
}

}  // namespace

Bounds bounds_in(const ConvexShape& shape, const Transform& frame) {
  const auto reach = [&](const Vector3& axis) {
    return axis.dot(shape.support(axis) - frame.position) + shape.rounding();
  };
  Bounds bounds;
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = frame.rotation.col(i);
    bounds.min()[i] = -reach(-axis);
    bounds.max()[i] = reach(axis);
  }
  return bounds;
}

void add_terrain_contacts(const ConvexShape& shape, const TriangleTree& tree, const Transform& mesh,
                          std::vector<ManifoldPoint>& points) {
  thread_local std::vector<std::uint32_t> near;
  near.clear();
  tree.near(bounds_in(shape, mesh), near);
  const Terrain terrain(tree, mesh);
  for (const std::uint32_t number : near) {
    NearTriangle triangle{number, terrain.placed(number), {}, 1};
    triangle.normal = plain_normal(triangle.corners);
    if (triangle.normal.dot(triangle.normal) < 0.5) continue;  // no area
    if ((shape.centre() - triangle.corners[0]).dot(triangle.normal) < 0) {
      triangle.normal = -triangle.normal;
      triangle.side = -1;
    }
    // Most triangles near a shape lie below it.
    const Vector3 lowest = shape.support(-triangle.normal);
    const double depth = shape.rounding() - (lowest - triangle.corners[0]).dot(triangle.normal);
    if (depth <= 0 || is_beside(shape, triangle)) continue;
    const ConvexShape flat(triangle.corners);
    // Where the surface has no edge, its face pushes: see classify_edge().
    if (depth < kMostLifted * shape.reach() && tree.is_plain(number, triangle.side < 0) &&
        add_area(shape, flat, triangle.normal, depth, points) > 0) {
      continue;
    }
    const std::optional<Penetration> overlap = allowed_overlap(shape, flat, terrain, triangle);
    if (overlap) add_manifold(shape, flat, *overlap, points);
  }
}

}  // namespace bubblesim
