// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/convex_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "meshes/growing_hull.hpp"
#include "meshes/mesh_piece.hpp"

namespace bubblesim {
namespace {

constexpr double kEnough = 0.01;         // excess at which no piece is cut any more
constexpr double kMerge = 0.002;         // of the mesh's volume, that joining two pieces may add
constexpr double kClosed = 0.01;         // relative difference of the volumes that the three axes give
constexpr double kThinnest = 1e-3;       // of the mesh's size along an axis: no slices below it
constexpr double kLongest = 0.01;        // of a piece's volume: cuts across its longest side are preferred by this much
constexpr double kBalance = 0.01;        // of a piece's volume: cuts through its middle are preferred by this much
constexpr std::size_t kMostPlanes = 12;  // tried along each axis
constexpr std::size_t kWork = 30'000;    // corners times planes, for each piece and axis

TriangleMesh cloud(std::vector<MeshPoint> points) {
  TriangleMesh mesh;
  mesh.vertices = std::move(points);
  return mesh;
}

double hull_volume(const Hull& hull) {
  return enclosed_volume(hull.triangles, [&](std::uint32_t i) { return hull.corners[i]; });
}

double joined_volume(const Hull& a, const Hull& b) {
  Eigen::AlignedBox3d bounds;
  for (const Hull* hull : {&a, &b}) {
    for (const Vector3& p : hull->corners) bounds.extend(p);
  }
  GrowingHull both(bounds.diagonal().norm());
  for (const Hull* hull : {&a, &b}) {
    for (const Vector3& p : hull->corners) both.add(p);
  }
  return both.volume();
}

class Divider {
 public:
  explicit Divider(const TriangleMesh& mesh) : all_(whole(mesh)) {
    std::array<double, 3> volumes{};
    for (std::size_t axis = 0; axis < 3; ++axis) volumes[axis] = flux_volume(all_, axis, all_.high[axis]);
    volume_ = volumes[0];
    for (const double other : volumes) closed_ = closed_ && std::abs(other - volume_) <= kClosed * std::abs(volume_);
    closed_ = closed_ && volume_ != 0;
  }

  bool closed() const { return closed_; }

  ConvexParts divide(const PartLimits& limits) {
    complete(all_);
    pieces_.push_back(all_);
    while (excess() > (pieces_.size() < limits.usual ? kEnough : limits.excess) && pieces_.size() < limits.most) {
      const auto worst = std::max_element(pieces_.begin(), pieces_.end(),
                                          [](const MeshPiece& a, const MeshPiece& b) { return a.excess < b.excess; });
      const std::optional<Plane> plane = best_plane(*worst);
      if (!plane) break;
      MeshPiece lower = cut(*worst, plane->axis, plane->at, false);
      MeshPiece upper = cut(*worst, plane->axis, plane->at, true);
      complete(lower);
      complete(upper);
      *worst = std::move(lower);
      pieces_.push_back(std::move(upper));
    }
    ConvexParts parts;
    parts.hulls = merged();
    double sum = 0;
    for (const Hull& hull : parts.hulls) sum += hull_volume(hull);
    parts.excess = sum / std::abs(volume_) - 1;
    return parts;
  }

 private:
  struct Plane {
    std::size_t axis = 0;
    float at = 0;
  };

  /// The hull of a piece, and what it adds to the mesh in the piece's box.
  void complete(MeshPiece& piece) const {
    piece.hull = convex_hull(cloud(piece.points));
    piece.volume = hull_volume(piece.hull);
    // The mesh between the planes across y and z, below the upper and the lower plane across x.
    MeshPiece column = cut(all_, 1, piece.low[1], true);
    column = cut(column, 1, piece.high[1], false);
    column = cut(column, 2, piece.low[2], true);
    column = cut(column, 2, piece.high[2], false);
    const double below_high = flux_volume(cut(column, 0, piece.high[0], false), 0, piece.high[0]);
    const double below_low = flux_volume(cut(column, 0, piece.low[0], false), 0, piece.low[0]);
    piece.excess = piece.volume - std::abs(below_high - below_low);
  }

  double excess() const {
    double sum = 0;
    for (const MeshPiece& piece : pieces_) sum += piece.volume;
    return sum / std::abs(volume_) - 1;
  }

  /// Coordinates of corners, as many as the work allows.
  std::vector<float> candidates(const MeshPiece& piece, std::size_t axis) const {
    const float thinnest = static_cast<float>(kThinnest) * (all_.high[axis] - all_.low[axis]);
    std::vector<float> found;
    for (const MeshPoint& point : piece.points) found.push_back(point[axis]);
    found.push_back((piece.low[axis] + piece.high[axis]) / 2);
    std::sort(found.begin(), found.end());
    std::vector<float> apart;
    for (const float at : found) {
      if (at < piece.low[axis] + thinnest || at > piece.high[axis] - thinnest) continue;
      if (apart.empty() || at > apart.back() + thinnest) apart.push_back(at);
    }
    const std::size_t most = std::clamp<std::size_t>(kWork / (piece.points.size() + 1), 3, kMostPlanes);
    if (apart.size() <= most) return apart;
    std::vector<float> some;
    for (std::size_t i = 0; i < most; ++i) some.push_back(apart[i * (apart.size() - 1) / (most - 1)]);
    return some;
  }

  /// The volumes of the hulls of what is on one side of each plane. From plane to plane the hull only grows.
  static std::vector<double> side_volumes(const MeshPiece& piece, const std::vector<PieceEdge>& edges, std::size_t axis,
                                          const std::vector<float>& planes, bool upper) {
    const auto height = [&](float at) { return upper ? -at : at; };
    std::vector<float> reached(piece.points.size(), std::numeric_limits<float>::infinity());  // by polygons at a point
    for (const std::vector<std::uint32_t>& polygon : piece.polygons) {
      float lowest = std::numeric_limits<float>::infinity();
      for (const std::uint32_t i : polygon) lowest = std::min(lowest, height(piece.points[i][axis]));
      for (const std::uint32_t i : polygon) reached[i] = std::min(reached[i], lowest);
    }
    std::vector<std::uint32_t> order(piece.points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return height(piece.points[a][axis]) < height(piece.points[b][axis]);
    });
    GrowingHull hull(std::hypot(length_along(piece, 0), length_along(piece, 1), length_along(piece, 2)));
    const auto add = [&](const MeshPoint& p) { hull.add({p[0], p[1], p[2]}); };
    std::vector<double> volumes(planes.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const std::size_t plane = upper ? planes.size() - 1 - k : k;
      const float at = planes[plane];
      for (; next < order.size() && height(piece.points[order[next]][axis]) < height(at); ++next) {
        add(piece.points[order[next]]);
      }
      for (std::size_t i = next; i < order.size() && piece.points[order[i]][axis] == at; ++i) {
        if (reached[order[i]] < height(at)) add(piece.points[order[i]]);
      }
      for (const auto& [from, to] : edges) {
        const MeshPoint& a = piece.points[from];
        const MeshPoint& b = piece.points[to];
        if ((a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at)) add(crossing(a, b, axis, at));
      }
      volumes[plane] = hull.volume();
    }
    return volumes;
  }

  std::optional<Plane> best_plane(const MeshPiece& piece) const {
    const std::vector<PieceEdge> edges = piece.edges();
    std::optional<Plane> best;
    double least = std::numeric_limits<double>::infinity();
    const double longest = std::max({length_along(piece, 0), length_along(piece, 1), length_along(piece, 2)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<float> planes = candidates(piece, axis);
      const std::vector<double> below = side_volumes(piece, edges, axis, planes, false);
      const std::vector<double> above = side_volumes(piece, edges, axis, planes, true);
      for (std::size_t i = 0; i < planes.size(); ++i) {
        const double cost = below[i] + above[i] + kBalance * std::abs(below[i] - above[i]) +
                            kLongest * piece.volume * (1 - length_along(piece, axis) / longest);
        if (cost >= least) continue;
        least = cost;
        best = Plane{axis, planes[i]};
      }
    }
    return best;
  }

  /// The hulls of the pieces; two of them are one where that adds little.
  std::vector<Hull> merged() const {
    std::vector<Hull> hulls;
    for (const MeshPiece& piece : pieces_) {
      if (!piece.hull.triangles.empty()) hulls.push_back(piece.hull);
    }
    for (std::size_t i = 0; i < hulls.size(); ++i) {
      for (std::size_t j = i + 1; j < hulls.size(); ++j) {
        if (joined_volume(hulls[i], hulls[j]) - hull_volume(hulls[i]) - hull_volume(hulls[j]) >
            kMerge * std::abs(volume_)) {
          continue;
        }
        std::vector<MeshPoint> points;
        for (const Hull* hull : {&hulls[i], &hulls[j]}) {
          for (const Vector3& p : hull->corners) {
            points.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
          }
        }
        hulls[i] = convex_hull(cloud(std::move(points)));
        hulls.erase(hulls.begin() + static_cast<std::ptrdiff_t>(j));
        j = i;  // again with all after it
      }
    }
    return hulls;
  }

  MeshPiece all_;
  std::vector<MeshPiece> pieces_;
  double volume_ = 0;  // of the mesh; negative when it is inside out
  bool closed_ = true;
};

}  // namespace

ConvexParts convex_parts(const TriangleMesh& mesh, const PartLimits& limits) {
  if (mesh.triangles.empty()) return {{}, std::numeric_limits<double>::infinity()};
  Divider divider(mesh);
  if (!divider.closed()) return {{}, std::numeric_limits<double>::infinity()};
  return divider.divide(limits);
}

}  // namespace bubblesim
