// SPDX-License-Identifier: BSD-3-Clause
// Extrudes polylines: the outline is triangulated by ear clipping (D. Eberly, "Triangulation by Ear Clipping").
#include <algorithm>
#include <cmath>
#include <list>
#include <utility>

#include "meshes/finish_mesh.hpp"
#include "meshes/made_meshes.hpp"
#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

using Point = Eigen::Vector2d;

bool coincide(const Point& a, const Point& b) {
  constexpr double kTolerance = 1e-6;  // m: files round the point that closes an outline
  return (a - b).lpNorm<Eigen::Infinity>() <= kTolerance;
}

/// Twice the signed area: positive when the corners run counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double area(const std::vector<Point>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += turn(outline.front(), outline[i], outline[(i + 1) % outline.size()]);
  }
  return twice / 2;
}

void drop_repeated(std::vector<Point>& outline) {
  outline.erase(std::unique(outline.begin(), outline.end(), coincide), outline.end());
  while (outline.size() > 1 && coincide(outline.front(), outline.back())) outline.pop_back();
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

/// Triangulates a simple outline that runs counter-clockwise.
class EarClipper {
 public:
  explicit EarClipper(const std::vector<Point>& outline) : outline_(outline) {
    for (std::uint32_t i = 0; i < outline.size(); ++i) left_.push_back(i);
  }

  std::vector<TriangleMesh::Triangle> clip() {
    std::vector<TriangleMesh::Triangle> triangles;
    while (left_.size() > 3) {
      Place ear = find_ear(false);
      // Connections to holes run back along themselves, and corners of holes may be on the line between two corners.
      if (ear == left_.end()) ear = find_ear(true);
      if (ear == left_.end()) throw MeshError("touches itself: it cannot be triangulated");
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

  Place find_ear(bool may_touch) const {
    Place ear = left_.begin();
    while (ear != left_.end() && !is_ear(ear, may_touch)) ++ear;
    return ear;
  }

  bool is_ear(Place place, bool may_touch) const {
    const auto [a, b, c] = around(place);
    if (turn(outline_[a], outline_[b], outline_[c]) < 0) return false;
    return std::none_of(left_.begin(), left_.end(), [&, a = a, b = b, c = c](std::uint32_t other) {
      if (other == a || other == b || other == c) return false;
      const Point& p = outline_[other];
      if (coincide(p, outline_[a]) || coincide(p, outline_[b]) || coincide(p, outline_[c])) return false;
      const double least = std::min(
          {turn(outline_[a], outline_[b], p), turn(outline_[b], outline_[c], p), turn(outline_[c], outline_[a], p)});
      return may_touch ? least > 0 : least >= 0;
    });
  }

  const std::vector<Point>& outline_;
  std::list<std::uint32_t> left_;
};

bool crosses(const Point& a, const Point& b, const Outline& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& c = outline[i];
    const Point& d = outline[(i + 1) % outline.size()];
    if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
  }
  return false;
}

bool cross(const Outline& one, const Outline& other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (crosses(one[i], one[(i + 1) % one.size()], other)) return true;
  }
  return false;
}

bool holds(const Outline& outline, const Point& point) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point& a = outline[i];
    const Point& b = outline[(i + 1) % outline.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool lies_in(const Outline& inner, const Outline& outer) {
  return std::all_of(inner.begin(), inner.end(), [&outer](const Point& point) { return holds(outer, point); });
}

/// Whether the line from corner `i` of a counter-clockwise outline to `point` starts inside the outline.
bool leads_inside(const Outline& outline, std::size_t i, const Point& point) {
  const Point& before = outline[(i + outline.size() - 1) % outline.size()];
  const Point& here = outline[i];
  const Point& after = outline[(i + 1) % outline.size()];
  if (turn(before, here, after) > 0) return turn(here, point, before) > 0 && turn(here, after, point) > 0;
  return !(turn(here, point, after) >= 0 && turn(here, before, point) >= 0);
}

/// Joins an outline and a hole, which runs clockwise, at their shortest connection to one outline.
void join(Outline& outline, const Outline& hole, const std::vector<Outline>& others) {
  struct Bridge {
    double length;
    std::size_t from, to;
  };
  std::vector<Bridge> bridges;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t j = 0; j < hole.size(); ++j) bridges.push_back({(outline[i] - hole[j]).norm(), i, j});
  }
  std::sort(bridges.begin(), bridges.end(), [](const Bridge& a, const Bridge& b) { return a.length < b.length; });
  for (const Bridge& bridge : bridges) {
    const Point& a = outline[bridge.from];
    const Point& b = hole[bridge.to];
    const auto blocks = [&](const Outline& other) { return crosses(a, b, other); };
    if (!leads_inside(outline, bridge.from, b) || blocks(outline) || blocks(hole) ||
        std::any_of(others.begin(), others.end(), blocks)) {
      continue;
    }
    Outline joined(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(bridge.from) + 1);
    for (std::size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(bridge.to + i) % hole.size()]);
    joined.insert(joined.end(), outline.begin() + static_cast<std::ptrdiff_t>(bridge.from), outline.end());
    outline = std::move(joined);
    return;
  }
  throw MeshError("has a hole that cannot be connected to its outline");
}

TriangleMesh::Point at_height(const Point& point, double z) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(z)};
}

/// The side walls; outside is to the right of the outline.
void add_walls(const Outline& outline, double height, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, height}) {
    for (const Point& point : outline) mesh.vertices.push_back(at_height(point, z));
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({first + i, first + next, first + next + count});
    mesh.triangles.push_back({first + i, first + next + count, first + i + count});
  }
}

/// Top and bottom of an outline that runs counter-clockwise.
void add_caps(const Outline& outline, double height, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double z : {0.0, height}) {
    for (const Point& point : outline) mesh.vertices.push_back(at_height(point, z));
  }
  for (const auto& [a, b, c] : EarClipper(outline).clip()) {
    mesh.triangles.push_back({first + c, first + b, first + a});
    mesh.triangles.push_back({first + a + count, first + b + count, first + c + count});
  }
}

void check(const Extrusion& part) {
  constexpr std::size_t kMaxCorners = 10'000;
  if (part.outline.size() < 3) throw MeshError("has fewer than three corners");
  if (part.outline.size() > kMaxCorners) throw MeshError("has more than 10000 corners");
  if (!(part.height > 0)) throw MeshError("must have a height above 0");
  if (area(part.outline) == 0) throw MeshError("has no area");
  if (crosses_itself(part.outline)) throw MeshError("crosses itself");
}

/// The number of other outlines that contain each part; 0 for a part that crosses another.
std::vector<std::size_t> depths(const std::vector<Extrusion>& parts) {
  std::vector<std::size_t> all;
  for (const Extrusion& part : parts) {
    std::size_t depth = 0;
    for (const Extrusion& other : parts) {
      if (&other == &part) continue;
      if (cross(part.outline, other.outline)) {
        depth = 0;
        break;
      }
      if (lies_in(part.outline, other.outline)) ++depth;
    }
    all.push_back(depth);
  }
  return all;
}

}  // namespace

std::shared_ptr<const TriangleMesh> extrude(std::vector<Extrusion> parts) {
  for (Extrusion& part : parts) {
    drop_repeated(part.outline);
    check(part);
    if (area(part.outline) < 0) std::reverse(part.outline.begin(), part.outline.end());
  }
  const std::vector<std::size_t> depth = depths(parts);
  TriangleMesh mesh;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (depth[i] % 2 != 0) continue;
    std::vector<Outline> holes;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (depth[j] != depth[i] + 1 || !lies_in(parts[j].outline, parts[i].outline)) continue;
      holes.emplace_back(parts[j].outline.rbegin(), parts[j].outline.rend());
    }
    add_walls(parts[i].outline, parts[i].height, mesh);
    for (const Outline& hole : holes) add_walls(hole, parts[i].height, mesh);
    Outline cut = parts[i].outline;
    while (!holes.empty()) {
      const Outline hole = std::move(holes.back());
      holes.pop_back();
      join(cut, hole, holes);
    }
    add_caps(cut, parts[i].height, mesh);
  }
  return finish_mesh(std::move(mesh));
}

}  // namespace bubblesim
