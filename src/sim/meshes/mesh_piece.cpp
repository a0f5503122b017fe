// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_piece.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace bubblesim {
namespace {

bool reaches(const MeshPiece& piece, const std::vector<std::uint32_t>& polygon, std::size_t axis, float at,
             bool upper) {
  return std::any_of(polygon.begin(), polygon.end(),
                     [&](std::uint32_t i) { return upper ? piece.points[i][axis] > at : piece.points[i][axis] < at; });
}

}  // namespace

std::vector<PieceEdge> MeshPiece::edges() const {
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

MeshPoint crossing(const MeshPoint& a, const MeshPoint& b, std::size_t axis, float at) {
  const float t = (at - a[axis]) / (b[axis] - a[axis]);
  MeshPoint point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = a[i] + t * (b[i] - a[i]);
  point[axis] = at;
  return point;
}

MeshPiece whole(const TriangleMesh& mesh) {
  MeshPiece piece;
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

MeshPiece cut(const MeshPiece& piece, std::size_t axis, float at, bool upper) {
  MeshPiece half;
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

double flux_volume(const MeshPiece& piece, std::size_t axis, double at) {
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

}  // namespace bubblesim
