// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/convex_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace bubblesim {
namespace {

using MeshPoint = TriangleMesh::Point;
using PieceEdge = std::pair<std::uint32_t, std::uint32_t>;

constexpr double kEnough = 0.01;         // excess at which no piece is cut any more
constexpr double kMerge = 0.002;         // of the mesh's volume, that joining two pieces may add
constexpr double kClosed = 0.01;         // relative difference of the volumes that the three axes give
constexpr double kThinnest = 1e-3;       // of the mesh's size along an axis: no slices below it
constexpr double kLongest = 0.01;        // of a piece's volume: prefers cuts across its longest side likewise
constexpr double kBalance = 0.01;        // of a piece's volume: prefers cuts through its middle to equally good ones
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

MeshPoint crossing(const MeshPoint& a, const MeshPoint& b, std::size_t axis, float at) {
  const float t = (at - a[axis]) / (b[axis] - a[axis]);
  MeshPoint point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = a[i] + t * (b[i] - a[i]);
  point[axis] = at;
  return point;
}

/// The surface of the mesh in a box, as convex polygons.
struct Piece {
  std::vector<MeshPoint> points;
  std::vector<std::vector<std::uint32_t>> polygons;
  MeshPoint low{};
  MeshPoint high{};
  Hull hull;
  double volume = 0;  // of the hull
  double excess = 0;  // of the hull over the mesh

  std::vector<PieceEdge> edges() const {
    std::vector<PieceEdge> all;
    for (const std::vector<std::uint32_t>& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        all.push_back(std::minmax(polygon[i], polygon[(i + 1) % polygon.size()]));
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }
};

double length_along(const Piece& piece, std::size_t axis) { return double{piece.high[axis]} - piece.low[axis]; }

Piece whole(const TriangleMesh& mesh) {
  Piece piece;
  std::map<MeshPoint, std::uint32_t> index_of;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    std::vector<std::uint32_t> polygon;
    for (const std::uint32_t corner : triangle) {
      const MeshPoint& place = mesh.vertices[corner];
      const auto [found, is_new] = index_of.try_emplace(place, static_cast<std::uint32_t>(piece.points.size()));
      if (is_new) piece.points.push_back(place);
      polygon.push_back(found->second);
    }
    piece.polygons.push_back(std::move(polygon));
  }
  piece.low = piece.high = piece.points.front();
  for (const MeshPoint& point : piece.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      piece.low[i] = std::min(piece.low[i], point[i]);
      piece.high[i] = std::max(piece.high[i], point[i]);
    }
  }
  return piece;
}

bool reaches(const Piece& piece, const std::vector<std::uint32_t>& polygon, std::size_t axis, float at, bool upper) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](std::uint32_t i) { return upper ? piece.points[i][axis] > at : piece.points[i][axis] < at; });
}

/// Which points belong to the halves of a piece. A point in the plane may be a corner of the solid on one side only.
struct Sides {
  std::vector<bool> lower;
  std::vector<bool> upper;
};
Sides sides_of(const Piece& piece, std::size_t axis, float at) {
  Sides sides{std::vector<bool>(piece.points.size()), std::vector<bool>(piece.points.size())};
  for (const std::vector<std::uint32_t>& polygon : piece.polygons) {
    const bool below = reaches(piece, polygon, axis, at, false);
    const bool above = reaches(piece, polygon, axis, at, true);
    for (const std::uint32_t i : polygon) {
      if (below && piece.points[i][axis] <= at) sides.lower[i] = true;
      if (above && piece.points[i][axis] >= at) sides.upper[i] = true;
    }
  }
  return sides;
}

/// The half of a piece on one side of a plane; without polygons in the plane, whose corners others have too.
Piece cut(const Piece& piece, std::size_t axis, float at, bool upper) {
  Piece half;
  half.low = piece.low;
  half.high = piece.high;
  (upper ? half.low : half.high)[axis] = at;
  std::map<PieceEdge, std::uint32_t> index_of;  // corners as edges from a point to itself
  const auto add = [&](const PieceEdge& key, const MeshPoint& point) {
    const auto [found, is_new] = index_of.try_emplace(key, static_cast<std::uint32_t>(half.points.size()));
    if (is_new) half.points.push_back(point);
    return found->second;
  };
  const auto inside = [&](const MeshPoint& point) { return upper ? point[axis] >= at : point[axis] <= at; };
  for (const std::vector<std::uint32_t>& polygon : piece.polygons) {
    if (!reaches(piece, polygon, axis, at, upper)) continue;
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t from = polygon[i];
      const std::uint32_t to = polygon[(i + 1) % polygon.size()];
      const MeshPoint& a = piece.points[from];
      const MeshPoint& b = piece.points[to];
      if (inside(a)) kept.push_back(add({from, from}, a));
      const bool crosses = (a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at);
      if (crosses) kept.push_back(add(std::minmax(from, to), crossing(a, b, axis, at)));
    }
    if (kept.size() > 2) half.polygons.push_back(std::move(kept));
  }
  return half;
}

/// Volume below a plane x = at, by the flux of (x - at, 0, 0) through the surface: caps across y and z have none.
double flux_volume(const Piece& piece, std::size_t axis, double at) {
  double sum = 0;
  for (const std::vector<std::uint32_t>& polygon : piece.polygons) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const std::array<const MeshPoint*, 3> p = {&piece.points[polygon[0]], &piece.points[polygon[i]],
                                                 &piece.points[polygon[i + 1]]};
      const std::size_t y = (axis + 1) % 3;
      const std::size_t z = (axis + 2) % 3;
      const auto d = [&](std::size_t corner, std::size_t k) { return double{(*p[corner])[k]} - double{(*p[0])[k]}; };
      const double area = (d(1, y) * d(2, z) - d(1, z) * d(2, y)) / 2;  // across the axis
      sum += area * (((*p[0])[axis] + (*p[1])[axis] + (*p[2])[axis]) / 3.0 - at);
    }
  }
  return sum;
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

  ConvexParts divide(std::size_t most) {
    complete(all_);
    pieces_.push_back(all_);
    while (pieces_.size() < most && excess() > kEnough) {
      const auto worst = std::max_element(pieces_.begin(), pieces_.end(),
                                          [](const Piece& a, const Piece& b) { return a.excess < b.excess; });
      const std::optional<Plane> plane = best_plane(*worst);
      if (!plane) break;
      Piece lower = cut(*worst, plane->axis, plane->at, false);
      Piece upper = cut(*worst, plane->axis, plane->at, true);
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
  void complete(Piece& piece) const {
    piece.hull = convex_hull(cloud(piece.points));
    piece.volume = hull_volume(piece.hull);
    // The mesh between the planes across y and z, below the upper and the lower plane across x.
    Piece column = cut(all_, 1, piece.low[1], true);
    column = cut(column, 1, piece.high[1], false);
    column = cut(column, 2, piece.low[2], true);
    column = cut(column, 2, piece.high[2], false);
    const double below_high = flux_volume(cut(column, 0, piece.high[0], false), 0, piece.high[0]);
    const double below_low = flux_volume(cut(column, 0, piece.low[0], false), 0, piece.low[0]);
    piece.excess = piece.volume - std::abs(below_high - below_low);
  }

  double excess() const {
    double sum = 0;
    for (const Piece& piece : pieces_) sum += piece.volume;
    return sum / std::abs(volume_) - 1;
  }

  /// Coordinates of corners, as many as the work allows.
  std::vector<float> candidates(const Piece& piece, std::size_t axis) const {
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

  std::optional<Plane> best_plane(const Piece& piece) const {
    const std::vector<PieceEdge> edges = piece.edges();
    std::optional<Plane> best;
    double least = std::numeric_limits<double>::infinity();
    const double longest = std::max({length_along(piece, 0), length_along(piece, 1), length_along(piece, 2)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const float at : candidates(piece, axis)) {
        std::vector<MeshPoint> lower;
        std::vector<MeshPoint> upper;
        const Sides sides = sides_of(piece, axis, at);
        for (std::size_t i = 0; i < piece.points.size(); ++i) {
          if (sides.lower[i]) lower.push_back(piece.points[i]);
          if (sides.upper[i]) upper.push_back(piece.points[i]);
        }
        for (const auto& [from, to] : edges) {
          const MeshPoint& a = piece.points[from];
          const MeshPoint& b = piece.points[to];
          if ((a[axis] < at) == (b[axis] < at) || a[axis] == at || b[axis] == at) continue;
          const MeshPoint point = crossing(a, b, axis, at);
          lower.push_back(point);
          upper.push_back(point);
        }
        const double below = hull_volume(convex_hull(cloud(std::move(lower))));
        const double above = hull_volume(convex_hull(cloud(std::move(upper))));
        const double cost = below + above + kBalance * std::abs(below - above) +
                            kLongest * piece.volume * (1 - length_along(piece, axis) / longest);
        if (cost >= least) continue;
        least = cost;
        best = Plane{axis, at};
      }
    }
    return best;
  }

  /// The hulls of the pieces; two of them are one where that adds little.
  std::vector<Hull> merged() const {
    std::vector<Hull> hulls;
    for (const Piece& piece : pieces_) {
      if (!piece.hull.triangles.empty()) hulls.push_back(piece.hull);
    }
    for (std::size_t i = 0; i < hulls.size(); ++i) {
      for (std::size_t j = i + 1; j < hulls.size(); ++j) {
        std::vector<MeshPoint> points;
        for (const Hull* hull : {&hulls[i], &hulls[j]}) {
          for (const Vector3& p : hull->corners) {
            points.push_back({static_cast<float>(p.X()), static_cast<float>(p.Y()), static_cast<float>(p.Z())});
          }
        }
        Hull both = convex_hull(cloud(std::move(points)));
        const double added = hull_volume(both) - hull_volume(hulls[i]) - hull_volume(hulls[j]);
        if (added > kMerge * std::abs(volume_)) continue;
        hulls[i] = std::move(both);
        hulls.erase(hulls.begin() + static_cast<std::ptrdiff_t>(j));
        j = i;  // again with all after it
      }
    }
    return hulls;
  }

  Piece all_;
  std::vector<Piece> pieces_;
  double volume_ = 0;  // of the mesh; negative when it is inside out
  bool closed_ = true;
};

}  // namespace

ConvexParts convex_parts(const TriangleMesh& mesh, std::size_t most) {
  if (mesh.triangles.empty()) return {{}, std::numeric_limits<double>::infinity()};
  Divider divider(mesh);
  const bool closed = divider.closed();
  ConvexParts parts = divider.divide(most);
  if (!closed) parts.excess = std::numeric_limits<double>::infinity();
  return parts;
}

}  // namespace bubblesim
