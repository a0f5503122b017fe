// SPDX-License-Identifier: BSD-3-Clause
#include "devices/displaced_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {
namespace {

struct HalfSpace {
  Vector3 up;
  double height;
  double above(const Vector3& point) const { return up.dot(point) - height; }
};

/// Adds the tetrahedron of a triangle and a point of the plane. The triangles of a closed surface below the plane add
/// up to the volume below it: the missing ones are in the plane and have no volume with the point.
void add_tetrahedron(Displaced& sum, const Vector3& apex, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double volume = (a - apex).dot((b - apex).cross(c - apex)) / 6;
  sum.volume += volume;
  sum.moment += (apex + a + b + c) * (volume / 4);
}

void add_triangle(Displaced& sum, const HalfSpace& water, const std::array<Vector3, 3>& corners) {
  const Vector3 apex = water.up * water.height;
  std::array<Vector3, 4> below;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& from = corners[i];
    const Vector3& to = corners[(i + 1) % 3];
    const double d = water.above(from);
    const double e = water.above(to);
    if (d <= 0) below[count++] = from;
    if ((d < 0 && e > 0) || (d > 0 && e < 0)) below[count++] = from + (to - from) * (d / (d - e));
  }
  for (std::size_t i = 2; i < count; ++i) add_tetrahedron(sum, apex, below[0], below[i - 1], below[i]);
}

Displaced of_mesh(const TriangleMesh& mesh, const HalfSpace& water) {
  Displaced sum;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    add_triangle(sum, water, {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)});
  }
  if (sum.volume < 0) return {-sum.volume, -sum.moment};  // its triangles face inwards
  return sum;
}

Displaced of_box(const Vector3& size, const HalfSpace& water) {
  Displaced sum;
  const auto corner = [half = Vector3(size / 2)](std::size_t bits) -> Vector3 {
    return {(bits & 1) != 0 ? half.x() : -half.x(), (bits & 2) != 0 ? half.y() : -half.y(),
            (bits & 4) != 0 ? half.z() : -half.z()};
  };
  // Two triangles a side, counter-clockwise seen from outside; bits: x, y, z.
  static constexpr std::size_t kSides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                               {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& side : kSides) {
    add_triangle(sum, water, {corner(side[0]), corner(side[1]), corner(side[2])});
    add_triangle(sum, water, {corner(side[0]), corner(side[2]), corner(side[3])});
  }
  return sum;
}

/// A spherical cap: pi h^2 (3 r - h) / 3 with its centroid 3 (2 r - h)^2 / (4 (3 r - h)) from the centre.
Displaced of_sphere(double radius, const HalfSpace& water) {
  const double depth = std::clamp(water.height + radius, 0.0, 2 * radius);
  const double volume = M_PI * depth * depth * (3 * radius - depth) / 3;
  const double below = M_PI * depth * depth * (2 * radius - depth) * (2 * radius - depth) / 4;
  return {volume, water.up * -below};
}

/// The unit sphere, stretched.
Displaced of_ellipsoid(const Vector3& radii, const HalfSpace& water) {
  const Vector3 stretched = water.up.cwiseProduct(radii);
  const double length = stretched.norm();
  const Displaced unit = of_sphere(1, {stretched / length, water.height / length});
  const double stretch = radii.prod();
  return {unit.volume * stretch, unit.moment.cwiseProduct(radii) * stretch};
}

/// The part of a disk of radius r in which a coordinate is below t: its area, and the integral of the coordinate.
std::array<double, 2> segment(double r, double t) {
  if (t >= r) return {M_PI * r * r, 0};
  if (t <= -r) return {0, 0};
  const double half_chord = std::sqrt((r - t) * (r + t));
  return {r * r * (M_PI / 2 + std::asin(t / r)) + t * half_chord, -2.0 / 3 * half_chord * half_chord * half_chord};
}

/// Integrates the disks of a solid of revolution about z between two heights by Gauss-Legendre quadrature. `radius` is
/// that of the disk at a height.
template <class Radius>
void add_disks(Displaced& sum, const HalfSpace& water, double from, double to, const Radius& radius) {
  static constexpr std::array<double, 8> kNodes = {0.0950125098376374, 0.2816035507792589, 0.4580167776572274,
                                                   0.6178762444026438, 0.7554044083550030, 0.8656312023878318,
                                                   0.9445750230732326, 0.9894009349916499};
  static constexpr std::array<double, 8> kWeights = {0.1894506104550685, 0.1826034150449236, 0.1691565193950025,
                                                     0.1495959888165767, 0.1246289712555339, 0.0951585116824928,
                                                     0.0622535239386479, 0.0271524594117541};
  const double slope = std::hypot(water.up.x(), water.up.y());
  const Vector3 uphill = slope > 0 ? Vector3(water.up.x() / slope, water.up.y() / slope, 0) : Vector3::UnitX();
  const auto add = [&](double z, double weight) {
    const double gap = water.height - z * water.up.z();  // up to the surface, from the middle of the disk
    const double r = radius(z);
    const double reach = slope > 1e-12 ? gap / slope : std::copysign(2 * r, gap);
    const auto [area, moment] = segment(r, reach);
    sum.volume += area * weight;
    sum.moment += (Vector3(0, 0, z) * area + uphill * moment) * weight;
  };
  const double middle = (from + to) / 2;
  const double half = (to - from) / 2;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    add(middle - half * kNodes[i], half * kWeights[i]);
    add(middle + half * kNodes[i], half * kWeights[i]);
  }
}

/// Adds the disks from `from` to `to`, divided where their form changes, which quadrature must not cross.
template <class Radius>
void add_parts(Displaced& sum, const HalfSpace& water, double from, double to, std::array<double, 2> changes,
               const Radius& radius) {
  for (double& change : changes) change = std::isnan(change) ? from : std::clamp(change, from, to);
  std::sort(changes.begin(), changes.end());
  for (const auto& [low, high] :
       {std::pair(from, changes[0]), std::pair(changes[0], changes[1]), std::pair(changes[1], to)}) {
    if (high > low) add_disks(sum, water, low, high, radius);
  }
}

void add_barrel(Displaced& sum, double r, double length, const HalfSpace& water) {
  const double slope = std::hypot(water.up.x(), water.up.y());
  // Where the surface enters and leaves the wall.
  const std::array<double, 2> changes = {(water.height - r * slope) / water.up.z(),
                                         (water.height + r * slope) / water.up.z()};
  add_parts(sum, water, -length / 2, length / 2, changes, [r](double) { return r; });
}

/// A half ball whose flat side is at `base`, above or below it.
void add_cap(Displaced& sum, double r, double base, bool upper, const HalfSpace& water) {
  const double slope = std::hypot(water.up.x(), water.up.y());
  const double gap = water.height - base * water.up.z();
  const double across = std::sqrt(std::max(r * r - gap * gap, 0.0)) * slope;
  const std::array<double, 2> changes = {base + gap * water.up.z() - across, base + gap * water.up.z() + across};
  const auto radius = [&](double z) { return std::sqrt(std::max(r * r - (z - base) * (z - base), 0.0)); };
  add_parts(sum, water, upper ? base : base - r, upper ? base + r : base, changes, radius);
}

struct Displacer {
  HalfSpace water;

  Displaced operator()(const Box& box) const { return of_box(box.size, water); }
  Displaced operator()(const Sphere& sphere) const { return of_sphere(sphere.radius, water); }
  Displaced operator()(const Ellipsoid& ellipsoid) const { return of_ellipsoid(ellipsoid.radii, water); }
  Displaced operator()(const Cylinder& cylinder) const {
    Displaced sum;
    add_barrel(sum, cylinder.radius, cylinder.length, water);
    return sum;
  }
  Displaced operator()(const Capsule& capsule) const {
    Displaced sum;
    add_barrel(sum, capsule.radius, capsule.length, water);
    add_cap(sum, capsule.radius, capsule.length / 2, true, water);
    add_cap(sum, capsule.radius, -capsule.length / 2, false, water);
    return sum;
  }
  Displaced operator()(const Plane&) const { return {}; }
  Displaced operator()(const Mesh& mesh) const { return of_mesh(*mesh.triangles, water); }
};

struct Reach {
  double operator()(const Box& box) const { return box.size.norm() / 2; }
  double operator()(const Sphere& sphere) const { return sphere.radius; }
  double operator()(const Ellipsoid& ellipsoid) const { return ellipsoid.radii.maxCoeff(); }
  double operator()(const Cylinder& cylinder) const { return std::hypot(cylinder.radius, cylinder.length / 2); }
  double operator()(const Capsule& capsule) const { return capsule.radius + capsule.length / 2; }
  double operator()(const Plane&) const { return 0; }
  double operator()(const Mesh& mesh) const {
    const Vector3 low = mesh.triangles->low;
    const Vector3 high = mesh.triangles->high;
    return high.cwiseMax(-low).norm();
  }
};

}  // namespace

Displaced displaced_below(const Geometry& geometry, const Vector3& up, double height) {
  return std::visit(Displacer{{up, height}}, geometry);
}

double reach_of(const Geometry& geometry) { return std::visit(Reach{}, geometry); }

}  // namespace bubblesim
