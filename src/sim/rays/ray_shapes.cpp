// SPDX-License-Identifier: BSD-3-Clause
#include "rays/ray_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The interval of a ray inside a convex shape, and the normal at its start.
struct Interval {
  double enter = -kNever;
  double leave = kNever;
  Vector3 normal;

  /// Clips to the part between two parallel planes `axis` * x = +-half.
  void clip_slab(double origin, double direction, double half, const Vector3& axis) {
    if (direction == 0) {
      if (std::abs(origin) > half) leave = -kNever;
      return;
    }
    const double first = (std::copysign(half, -direction) - origin) / direction;
    const double last = (std::copysign(half, direction) - origin) / direction;
    if (first > enter) {
      enter = first;
      normal = direction > 0 ? -axis : axis;
    }
    leave = std::min(leave, last);
  }
};

/// The interval in which a t^2 + 2 b t + c <= 0.
std::optional<std::pair<double, double>> inside_quadric(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0 || a == 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  return std::make_pair((-b - root) / a, (-b + root) / a);
}

struct Intersector {
  const Ray& ray;

  std::optional<ShapeHit> operator()(const Box& box) const {
    Interval inside;
    inside.clip_slab(ray.origin.x(), ray.direction.x(), box.size.x() / 2, Vector3::UnitX());
    inside.clip_slab(ray.origin.y(), ray.direction.y(), box.size.y() / 2, Vector3::UnitY());
    inside.clip_slab(ray.origin.z(), ray.direction.z(), box.size.z() / 2, Vector3::UnitZ());
    return entry(inside);
  }

  std::optional<ShapeHit> operator()(const Sphere& sphere) const {
    const auto roots =
        inside_quadric(1, ray.origin.dot(ray.direction), ray.origin.squaredNorm() - sphere.radius * sphere.radius);
    if (!roots) return std::nullopt;
    return entry({roots->first, roots->second, (ray.origin + ray.direction * roots->first) / sphere.radius});
  }

  std::optional<ShapeHit> operator()(const Cylinder& cylinder) const {
    const Vector3& o = ray.origin;
    const Vector3& d = ray.direction;
    Interval inside;
    const double a = d.x() * d.x() + d.y() * d.y();
    const double c = o.x() * o.x() + o.y() * o.y() - cylinder.radius * cylinder.radius;
    if (a == 0) {
      if (c > 0) return std::nullopt;
    } else {
      const auto roots = inside_quadric(a, o.x() * d.x() + o.y() * d.y(), c);
      if (!roots) return std::nullopt;
      const Vector3 side = o + d * roots->first;
      inside = {roots->first, roots->second, Vector3(side.x(), side.y(), 0) / cylinder.radius};
    }
    inside.clip_slab(o.z(), d.z(), cylinder.length / 2, Vector3::UnitZ());
    return entry(inside);
  }

  /// The entry is the first entry of its cylinder and its two spheres.
  std::optional<ShapeHit> operator()(const Capsule& capsule) const {
    Interval first;
    first.enter = kNever;
    const auto take = [&first](double enter, const Vector3& normal) {
      if (enter < first.enter) first = {enter, kNever, normal};
    };
    const Vector3& o = ray.origin;
    const Vector3& d = ray.direction;
    const double half = capsule.length / 2;
    const double r = capsule.radius;
    const double c = o.x() * o.x() + o.y() * o.y() - r * r;
    if (const auto side = inside_quadric(d.x() * d.x() + d.y() * d.y(), o.x() * d.x() + o.y() * d.y(), c)) {
      const Vector3 place = o + d * side->first;
      if (std::abs(place.z()) <= half) take(side->first, Vector3(place.x(), place.y(), 0) / r);
    }
    for (const double end : {-half, half}) {
      const Vector3 from_end = o - Vector3(0, 0, end);
      const auto ball = inside_quadric(1, from_end.dot(d), from_end.squaredNorm() - r * r);
      if (ball) take(ball->first, (from_end + d * ball->first) / r);
    }
    return first.enter < kNever ? entry(first) : std::nullopt;
  }

  /// A unit sphere after division by the radii.
  std::optional<ShapeHit> operator()(const Ellipsoid& ellipsoid) const {
    const Vector3 o = ray.origin.cwiseQuotient(ellipsoid.radii);
    const Vector3 d = ray.direction.cwiseQuotient(ellipsoid.radii);
    const auto roots = inside_quadric(d.squaredNorm(), o.dot(d), o.squaredNorm() - 1);
    if (!roots) return std::nullopt;
    const Vector3 normal = (o + d * roots->first).cwiseQuotient(ellipsoid.radii);
    return entry({roots->first, roots->second, normal.normalized()});
  }

  /// Tests every triangle, front faces only: for occasional queries; sensors use Embree. Möller and Trumbore, "Fast,
  /// Minimum Storage Ray/Triangle Intersection", 1997.
  std::optional<ShapeHit> operator()(const Mesh& mesh) const {
    const TriangleMesh& triangles = *mesh.triangles;
    if (!meets_box(triangles.low, triangles.high)) return std::nullopt;
    std::optional<ShapeHit> nearest;
    for (const TriangleMesh::Triangle& triangle : triangles.triangles) {
      const Vector3 corner = triangles.corner(triangle, 0);
      const Vector3 first = triangles.corner(triangle, 1) - corner;
      const Vector3 second = triangles.corner(triangle, 2) - corner;
      const Vector3 p = ray.direction.cross(second);
      const double determinant = first.dot(p);
      if (determinant <= 0) continue;
      const Vector3 from_corner = ray.origin - corner;
      const double u = from_corner.dot(p);
      const Vector3 q = from_corner.cross(first);
      const double v = ray.direction.dot(q);
      if (u < 0 || v < 0 || u + v > determinant) continue;
      const double distance = second.dot(q) / determinant;
      if (distance < 0 || (nearest && distance >= nearest->distance)) continue;
      nearest = ShapeHit{distance, first.cross(second).normalized()};
    }
    return nearest;
  }

  std::optional<ShapeHit> operator()(const Plane& plane) const {
    const Vector3 normal = plane.normal.normalized();
    const double height = normal.dot(ray.origin);
    const double descent = -normal.dot(ray.direction);
    if (height < 0 || descent <= 0) return std::nullopt;
    return ShapeHit{height / descent, normal};
  }

 private:
  bool meets_box(const Vector3& low, const Vector3& high) const {
    const Vector3 from_middle = ray.origin - (low + high) / 2;
    const Vector3 half = (high - low) / 2;
    Interval inside;
    inside.clip_slab(from_middle.x(), ray.direction.x(), half.x(), Vector3::UnitX());
    inside.clip_slab(from_middle.y(), ray.direction.y(), half.y(), Vector3::UnitY());
    inside.clip_slab(from_middle.z(), ray.direction.z(), half.z(), Vector3::UnitZ());
    return inside.leave >= 0 && inside.enter <= inside.leave;
  }

  static std::optional<ShapeHit> entry(const Interval& inside) {
    if (inside.enter < 0 || inside.enter > inside.leave) return std::nullopt;
    return ShapeHit{inside.enter, inside.normal};
  }
};

struct Inside {
  const Vector3& point;

  bool operator()(const Box& box) const {
    const Vector3 half = box.size / 2;
    return std::abs(point.x()) < half.x() && std::abs(point.y()) < half.y() && std::abs(point.z()) < half.z();
  }
  bool operator()(const Sphere& sphere) const { return point.squaredNorm() < sphere.radius * sphere.radius; }
  bool operator()(const Cylinder& cylinder) const {
    return std::abs(point.z()) < cylinder.length / 2 &&
           point.x() * point.x() + point.y() * point.y() < cylinder.radius * cylinder.radius;
  }
  bool operator()(const Capsule& capsule) const {
    const double half = capsule.length / 2;
    const Vector3 nearest(0, 0, std::clamp(point.z(), -half, half));
    return (point - nearest).squaredNorm() < capsule.radius * capsule.radius;
  }
  bool operator()(const Ellipsoid& ellipsoid) const { return point.cwiseQuotient(ellipsoid.radii).squaredNorm() < 1; }
  bool operator()(const Plane& plane) const { return plane.normal.dot(point) < 0; }
  bool operator()(const Mesh&) const { return false; }  // a surface; its back faces are not hit
};

}  // namespace

bool is_inside(const Vector3& point, const Geometry& geometry) { return std::visit(Inside{point}, geometry); }

std::optional<ShapeHit> intersect(const Ray& ray, const Geometry& geometry, double max_distance) {
  std::optional<ShapeHit> hit = std::visit(Intersector{ray}, geometry);
  if (hit && hit->distance > max_distance) hit.reset();
  return hit;
}

}  // namespace bubblesim
