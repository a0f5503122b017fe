// SPDX-License-Identifier: BSD-3-Clause
// Polylines: the outline is cut into triangles by clipping ears, as D. Eberly's "Triangulation by Ear Clipping" tells.
#include <algorithm>
#include <cmath>
#include <list>

#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

using Point = ignition::math::Vector2d;

/// Twice the signed area: positive when the corners run counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.X() - a.X()) * (c.Y() - a.Y()) - (b.Y() - a.Y()) * (c.X() - a.X());
}

double area(const std::vector<Point>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += turn(outline.front(), outline[i], outline[(i + 1) % outline.size()]);
  }
  return twice / 2;
}

void drop_repeated(std::vector<Point>& outline) {
  outline.erase(std::unique(outline.begin(), outline.end()), outline.end());
  while (outline.size() > 1 && outline.front() == outline.back()) outline.pop_back();
}

bool crosses_itself(const std::vector<Point>& outline) {
  const auto corner = [&](std::size_t i) -> const Point& { return outline[i % outline.size()]; };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t j = i + 2; j < outline.size(); ++j) {
      const Point& a = corner(i);
      const Point& b = corner(i + 1);
      const Point& c = corner(j);
      const Point& d = corner(j + 1);
      if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
    }
  }
  return false;
}

/// Triangles of a simple outline that runs counter-clockwise.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Point>& outline) : outline_(outline) {
    for (std::uint32_t i = 0; i < outline.size(); ++i) left_.push_back(i);
  }

  std::vector<TriangleMesh::Triangle> clip() {
    std::vector<TriangleMesh::Triangle> triangles;
    while (left_.size() > 3) {
      Place ear = left_.begin();
      while (ear != left_.end() && !is_ear(ear)) ++ear;
      if (ear == left_.end()) throw MeshError("touches itself: its triangles cannot be told");
      triangles.push_back(around(ear));
      left_.erase(ear);
    }
    triangles.push_back(around(std::next(left_.begin())));
    return triangles;
  }

 private:
  using Place = std::list<std::uint32_t>::const_iterator;

  TriangleMesh::Triangle around(Place place) const {
    const Place before = place == left_.begin() ? std::prev(left_.end()) : std::prev(place);
    const Place after = std::next(place) == left_.end() ? left_.begin() : std::next(place);
    return {*before, *place, *after};
  }

  bool is_ear(Place place) const {
    const auto [a, b, c] = around(place);
    if (turn(outline_[a], outline_[b], outline_[c]) < 0) return false;
    return std::none_of(left_.begin(), left_.end(), [&, a = a, b = b, c = c](std::uint32_t other) {
      if (other == a || other == b || other == c) return false;
      const Point& p = outline_[other];
      if (p == outline_[a] || p == outline_[b] || p == outline_[c]) return false;
      return turn(outline_[a], outline_[b], p) >= 0 && turn(outline_[b], outline_[c], p) >= 0 &&
             turn(outline_[c], outline_[a], p) >= 0;
    });
  }

  const std::vector<Point>& outline_;
  std::list<std::uint32_t> left_;
};

}  // namespace

void append(const TriangleMesh& mesh, TriangleMesh& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const auto& [a, b, c] : mesh.triangles) to.triangles.push_back({first + a, first + b, first + c});
}

std::shared_ptr<const TriangleMesh> extrude(std::vector<Point> outline, double height) {
  constexpr std::size_t kMaxCorners = 10'000;
  drop_repeated(outline);
  if (outline.size() < 3) throw MeshError("has less than three corners");
  if (outline.size() > kMaxCorners) throw MeshError("has over 10000 corners");
  if (!(height > 0)) throw MeshError("has no height above 0");
  if (area(outline) < 0) std::reverse(outline.begin(), outline.end());
  if (!(area(outline) > 0)) throw MeshError("has no area");
  if (crosses_itself(outline)) throw MeshError("crosses itself");
  const auto count = static_cast<std::uint32_t>(outline.size());
  TriangleMesh mesh;
  for (const double z : {0.0, height}) {
    for (const Point& point : outline) {
      mesh.vertices.push_back({static_cast<float>(point.X()), static_cast<float>(point.Y()), static_cast<float>(z)});
    }
  }
  for (const auto& [a, b, c] : EarClipper(outline).clip()) {
    mesh.triangles.push_back({c, b, a});
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
  }
  return finish_mesh(std::move(mesh));
}

}  // namespace bubblesim
