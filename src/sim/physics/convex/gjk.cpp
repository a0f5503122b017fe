// SPDX-License-Identifier: BSD-3-Clause
#include "physics/convex/gjk.hpp"

#include <algorithm>
#include <cmath>

namespace bubblesim {
namespace {

constexpr int kMaxRounds = 64;
constexpr double kRelative = 1e-12;  // of the squared distance, at which it has converged
constexpr double kTouching = 1e-12;  // of the shapes' reach

/// Points of the simplex with their weights in the point nearest to the origin.
struct Simplex {
  std::array<DifferencePoint, 4> points;
  std::array<double, 4> weights{};
  int count = 0;

  const Vector3& at(int i) const { return points[static_cast<std::size_t>(i)].at; }
  void keep(std::initializer_list<std::pair<int, double>> kept) {
    const std::array<DifferencePoint, 4> before = points;
    count = 0;
    for (const auto& [index, weight] : kept) {
      points[static_cast<std::size_t>(count)] = before[static_cast<std::size_t>(index)];
      weights[static_cast<std::size_t>(count++)] = weight;
    }
  }
  template <class Pick>
  Vector3 mean(const Pick& pick) const {
    Vector3 sum;
    for (int i = 0; i < count; ++i) {
      sum += pick(points[static_cast<std::size_t>(i)]) * weights[static_cast<std::size_t>(i)];
    }
    return sum;
  }
};

/// Weights of the point of a triangle nearest to the origin. Ericson, Real-Time Collision Detection, 5.1.5.
std::array<double, 3> nearest_on_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double d1 = -ab.dot(a);
  const double d2 = -ac.dot(a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = -ab.dot(b);
  const double d4 = -ac.dot(b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = -ab.dot(c);
  const double d6 = -ac.dot(c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return {1, 0, 0};  // no area: rounding got past its edges
  return {va / sum, vb / sum, vc / sum};
}

void reduce_segment(Simplex& s) {
  const Vector3 ab = s.at(1) - s.at(0);
  const double whole = ab.squaredNorm();
  const double t = whole > 0 ? -s.at(0).dot(ab) / whole : 0;
  if (t <= 0) return s.keep({{0, 1}});
  if (t >= 1) return s.keep({{1, 1}});
  s.keep({{0, 1 - t}, {1, t}});
}

void keep_weighted(Simplex& s, const std::array<int, 3>& corners, const std::array<double, 3>& weights) {
  const std::array<DifferencePoint, 4> before = s.points;
  s.count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (weights[i] == 0) continue;
    s.points[static_cast<std::size_t>(s.count)] = before[static_cast<std::size_t>(corners[i])];
    s.weights[static_cast<std::size_t>(s.count++)] = weights[i];
  }
}

/// Reduces to the face nearest to the origin; keeps all four points if the origin is inside.
void reduce_tetrahedron(Simplex& s) {
  constexpr std::array<std::array<int, 4>, 4> kFaces = {{{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
  double best = std::numeric_limits<double>::infinity();
  std::array<int, 3> corners{};
  std::array<double, 3> weights{};
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Vector3 normal = (s.at(j) - s.at(i)).cross(s.at(k) - s.at(i));
    const double inner = (s.at(opposite) - s.at(i)).dot(normal);
    const double origin = -s.at(i).dot(normal);
    if (inner * origin > 0) continue;  // on the inner side of this face; a flat tetrahedron has no inner side
    const std::array<double, 3> w = nearest_on_triangle(s.at(i), s.at(j), s.at(k));
    const Vector3 point = s.at(i) * w[0] + s.at(j) * w[1] + s.at(k) * w[2];
    if (point.squaredNorm() >= best) continue;
    best = point.squaredNorm();
    corners = {i, j, k};
    weights = w;
  }
  if (best < std::numeric_limits<double>::infinity()) keep_weighted(s, corners, weights);
}

void reduce(Simplex& s) {
  if (s.count == 1) s.weights[0] = 1;
  if (s.count == 2) reduce_segment(s);
  if (s.count == 3) keep_weighted(s, {0, 1, 2}, nearest_on_triangle(s.at(0), s.at(1), s.at(2)));
  if (s.count == 4) reduce_tetrahedron(s);
}

}  // namespace

DifferencePoint difference_point(const ConvexShape& a, const ConvexShape& b, const Vector3& direction) {
  const Vector3 on_a = a.support(direction);
  const Vector3 on_b = b.support(-direction);
  return {on_a - on_b, on_a, on_b};
}

CoreDistance core_distance(const ConvexShape& a, const ConvexShape& b, double limit) {
  const double scale = a.reach() + b.reach();
  Simplex simplex;
  Vector3 nearest = a.centre() - b.centre();
  if (nearest.squaredNorm() == 0) nearest = Vector3::UnitX();
  double squared = std::numeric_limits<double>::infinity();
  CoreDistance result;
  for (int round = 0; round < kMaxRounds; ++round) {
    const DifferencePoint next = difference_point(a, b, -nearest);
    const double progress = nearest.dot(next.at);
    const double size = nearest.squaredNorm();
    // All of A - B lies beyond this plane.
    if (progress > 0 && progress * progress > limit * limit * size) {
      result.distance = progress / std::sqrt(size);
      return result;
    }
    if (simplex.count > 0 && size - progress <= kRelative * size) break;
    const auto same = [&](const DifferencePoint& p) { return p.at == next.at; };
    if (std::any_of(simplex.points.begin(), simplex.points.begin() + simplex.count, same)) break;
    const Simplex before = simplex;
    simplex.points[static_cast<std::size_t>(simplex.count++)] = next;
    reduce(simplex);
    const Vector3 found = simplex.mean([](const DifferencePoint& p) -> const Vector3& { return p.at; });
    const double now = found.squaredNorm();
    if (simplex.count == 4 || now <= kTouching * kTouching * scale * scale) {
      result.overlap = true;
      result.simplex = simplex.points;
      result.count = simplex.count;
      return result;
    }
    if (now >= squared) {  // as near as rounding allows
      simplex = before;
      break;
    }
    squared = now;
    nearest = found;
  }
  result.on_a = simplex.mean([](const DifferencePoint& p) -> const Vector3& { return p.on_a; });
  result.on_b = simplex.mean([](const DifferencePoint& p) -> const Vector3& { return p.on_b; });
  result.distance = std::sqrt(squared);
  return result;
}

}  // namespace bubblesim
