// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/models/auto_inertia.hpp"

#include <array>
#include <cmath>
#include <variant>

#include "bubblesim/triangle_mesh.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

Matrix3 diagonal(double x, double y, double z) { return Vector3(x, y, z).asDiagonal(); }

/// Sums of the tetrahedra of the triangles and a point.
Solid solid_of_mesh(const TriangleMesh& mesh) {
  constexpr double kOpen = 1e-3;  // of the surface: single precision closes meshes to 1e-6
  const Vector3 apex = (mesh.low + mesh.high) / 2;
  double volume = 0;
  double surface = 0;
  Vector3 first;
  Vector3 normals;
  Matrix3 second = Matrix3::Zero();
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    const Vector3 a = mesh.corner(triangle, 0) - apex;
    const Vector3 b = mesh.corner(triangle, 1) - apex;
    const Vector3 c = mesh.corner(triangle, 2) - apex;
    const Vector3 sum = a + b + c;
    const Vector3 normal = (b - a).cross(c - a);
    const double part = a.dot(b.cross(c)) / 6;
    normals += normal;
    surface += normal.norm();
    volume += part;
    first += part / 4 * sum;
    second += part / 20 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  Solid solid;
  solid.is_closed = normals.norm() <= kOpen * surface;
  if (volume == 0) return solid;
  const Vector3 centre = first / volume;
  const double side = volume < 0 ? -1 : 1;  // its triangles face inwards
  solid.volume = side * volume;
  solid.centre = apex + centre;
  solid.second_moment = side * (second - volume * centre * centre.transpose());
  return solid;
}

struct SolidOf {
  Solid operator()(const Box& box) const {
    const double volume = box.size.prod();
    const Vector3 squares = box.size.cwiseAbs2();
    return {volume, Vector3(), volume / 12 * Matrix3(squares.asDiagonal())};
  }
  Solid operator()(const Sphere& sphere) const {
    const double r = sphere.radius;
    const double volume = 4 * M_PI / 3 * r * r * r;
    return {volume, Vector3(), volume * r * r / 5 * Matrix3::Identity()};
  }
  Solid operator()(const Ellipsoid& ellipsoid) const {
    const double volume = 4 * M_PI / 3 * ellipsoid.radii.prod();
    const Vector3 squares = ellipsoid.radii.cwiseAbs2();
    return {volume, Vector3(), volume / 5 * Matrix3(squares.asDiagonal())};
  }
  Solid operator()(const Cylinder& cylinder) const {
    const double r = cylinder.radius;
    const double l = cylinder.length;
    const double volume = M_PI * r * r * l;
    return {volume, Vector3(), volume * diagonal(r * r / 4, r * r / 4, l * l / 12)};
  }
  /// A cylinder between two half balls, whose centroids are 3 r / 8 from their flat sides.
  Solid operator()(const Capsule& capsule) const {
    const double r = capsule.radius;
    const double l = capsule.length;
    const double barrel = M_PI * r * r * l;
    const double ball = 4 * M_PI / 3 * r * r * r;
    const double across = barrel * r * r / 4 + ball * r * r / 5;
    const double along = barrel * l * l / 12 + ball * (l * l / 4 + 3 * l * r / 8 + r * r / 5);
    return {barrel + ball, Vector3(), diagonal(across, across, along)};
  }
  Solid operator()(const Plane&) const { return {}; }
  Solid operator()(const Mesh& mesh) const { return solid_of_mesh(*mesh.triangles); }
};

/// The mesh of a cone has flat sides: its volume would be 1 % less.
Solid solid_of_cone(double r, double l) {
  const double volume = M_PI * r * r * l / 3;
  return {volume, Vector3(0, 0, -l / 4), volume * diagonal(3 * r * r / 20, 3 * r * r / 20, 3 * l * l / 80)};
}

Solid solid_of(const SdfElement& collision, const Geometry& geometry) {
  const SdfElement cone = collision.child("geometry").child("cone");
  return cone ? solid_of_cone(cone.number("radius"), cone.number("length")) : solid_of(geometry);
}

/// Its own density, or else that of <inertial>, which has a default. kg/m^3
double density_of(const SdfElement& collision, const SdfElement& inertial, const std::string& path,
                  LoadContext& context) {
  const SdfElement& from = collision.has("density") ? collision : inertial;
  const double density = from.number("density");
  if (density > 0 && std::isfinite(density)) return density;
  context.report(from.source("density"), path,
                 "<density> is " + text(density) + " kg/m^3, it must be above 0 and finite");
  return 1;
}

}  // namespace

Solid solid_of(const Geometry& geometry) { return std::visit(SolidOf{}, geometry); }

void set_auto_inertia(const SdfElement& inertial, const std::vector<SdfElement>& read, const std::string& path,
                      LinkDescription& link, LoadContext& context) {
  double mass = 0;
  Vector3 first;
  Matrix3 second = Matrix3::Zero();  // about the origin of the link
  for (std::size_t i = 0; i < read.size(); ++i) {
    const CollisionDescription& collision = link.collisions[i];
    const std::string at = path + "/" + collision.name;
    const double density = density_of(read[i], inertial, at, context);
    const Solid solid = solid_of(read[i], collision.geometry);
    if (!(solid.volume > 0) || !solid.is_closed) {
      context.warn(collision.source, at,
                   std::string(solid.is_closed ? "has no volume" : "is not closed") +
                       ", it adds no mass to <inertial auto=\"true\">");
      continue;
    }
    const double part = density * solid.volume;
    const Vector3 centre = collision.pose * solid.centre;
    const Matrix3 turn = collision.pose.orientation.toRotationMatrix();
    mass += part;
    first += part * centre;
    second += density * turn * solid.second_moment * turn.transpose() + part * centre * centre.transpose();
  }
  if (mass == 0) {
    context.report(
        inertial.source(), path,
        "<inertial auto=\"true\"> has no collision shape with a volume; add a <collision>, or leave auto out "
        "and give <mass> and <inertia>");
    return;
  }
  link.centre_of_mass = first / mass;
  second -= mass * link.centre_of_mass * link.centre_of_mass.transpose();
  link.mass = inertial.has("mass") ? inertial.number("mass") : mass;
  second *= link.mass / mass;
  link.inertia_diagonal = second.trace() * Vector3::Ones() - second.diagonal();
  link.inertia_products = Vector3() - Vector3(second(0, 1), second(0, 2), second(1, 2));  // no -0
}

}  // namespace bubblesim
