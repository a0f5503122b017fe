// SPDX-License-Identifier: BSD-3-Clause
#include "physics/contacts/convex_geom.hpp"

#include <optional>

#include "physics/convex/manifold.hpp"
#include "physics/convex/terrain_contacts.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/parts/collider.hpp"

namespace bubblesim {
namespace {

using Parts = std::vector<ConvexPart>;

const CollisionMesh& mesh_of(dGeomID geom) { return **static_cast<const CollisionMesh**>(dGeomGetClassData(geom)); }

const Parts& parts_of(dGeomID geom) { return mesh_of(geom).parts; }

void find_bounds(dGeomID geom, dReal bounds[6]) {
  const Transform frame = geom_transform(geom);
  const ConvexPart& whole = mesh_of(geom).whole();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vector3 axis = frame.rotation.row(i).transpose();  // of the world, in the shape
    bounds[2 * i] = frame.position[i] + axis.dot(whole.corners[whole.farthest(-axis, 0)]);
    bounds[2 * i + 1] = frame.position[i] + axis.dot(whole.corners[whole.farthest(axis, 0)]);
  }
}

int convex_class() {
  static const int number = [] {
    dGeomClass description{};
    description.bytes = sizeof(const CollisionMesh*);
    description.collider = [](int) -> dColliderFn* { return nullptr; };
    description.aabb = find_bounds;
    return dCreateGeomClass(&description);
  }();
  return number;
}

void add_plane_contacts(dGeomID convex, dGeomID plane, std::vector<ManifoldPoint>& points) {
  dVector4 values;
  dGeomPlaneGetParams(plane, values);
  const Vector3 normal = to_vector(values);
  const Transform frame = geom_transform(convex);
  for (const ConvexPart& part : parts_of(convex)) {
    for (const Vector3& corner : part.corners) {
      const Vector3 at = frame * corner;
      const double depth = values[3] - at.dot(normal);
      if (depth > 0) points.push_back({at, normal, depth});
    }
  }
}

void add_mesh_contacts(dGeomID convex, dGeomID mesh, std::vector<ManifoldPoint>& points) {
  const TriangleTree& tree = collider_of(mesh).mesh->tree();
  const Transform frame = geom_transform(mesh);
  const Transform own = geom_transform(convex);
  for (const ConvexPart& part : parts_of(convex)) add_terrain_contacts(ConvexShape(part, own), tree, frame, points);
}

void add_convex_contacts(dGeomID first, dGeomID second, std::vector<ManifoldPoint>& points) {
  thread_local std::vector<ConvexShape> of_first;
  thread_local std::vector<ConvexShape> of_second;
  shapes_of(first, of_first);
  shapes_of(second, of_second);
  for (const ConvexShape& a : of_first) {
    for (const ConvexShape& b : of_second) {
      if ((a.centre() - b.centre()).norm() > a.reach() + b.reach()) continue;
      if (const std::optional<Penetration> overlap = penetration(a, b)) add_manifold(a, b, *overlap, points);
    }
  }
}

}  // namespace

void shapes_of(dGeomID geom, std::vector<ConvexShape>& shapes) {
  shapes.clear();
  if (!is_convex_geom(geom)) {
    if (ConvexShape::knows(geom)) shapes.emplace_back(geom);
    return;
  }
  const Transform frame = geom_transform(geom);
  for (const ConvexPart& part : parts_of(geom)) shapes.emplace_back(part, frame);
}

dGeomID create_convex(const CollisionMesh& mesh) {
  dGeomID geom = dCreateGeom(convex_class());
  *static_cast<const CollisionMesh**>(dGeomGetClassData(geom)) = &mesh;
  return geom;
}

bool is_convex_geom(dGeomID geom) { return dGeomGetClass(geom) == convex_class(); }

void find_convex_contacts(dGeomID first, dGeomID second, std::vector<dContactGeom>& contacts) {
  thread_local std::vector<ManifoldPoint> points;
  points.clear();
  contacts.clear();
  // Planes and meshes push the other shape.
  const int kind = dGeomGetClass(first);
  const bool reversed = kind == dPlaneClass || kind == dTriMeshClass;
  dGeomID convex = reversed ? second : first;
  dGeomID other = reversed ? first : second;
  switch (dGeomGetClass(other)) {
    case dPlaneClass:
      add_plane_contacts(convex, other, points);
      break;
    case dTriMeshClass:
      add_mesh_contacts(convex, other, points);
      break;
    default:
      add_convex_contacts(convex, other, points);
  }
  const double sign = reversed ? -1 : 1;
  for (const ManifoldPoint& point : points) {
    dContactGeom contact{};
    contact.pos[0] = point.at.x();
    contact.pos[1] = point.at.y();
    contact.pos[2] = point.at.z();
    contact.normal[0] = sign * point.normal.x();
    contact.normal[1] = sign * point.normal.y();
    contact.normal[2] = sign * point.normal.z();
    contact.depth = point.depth;
    contact.g1 = first;
    contact.g2 = second;
    contact.side1 = contact.side2 = -1;
    contacts.push_back(contact);
  }
}

}  // namespace bubblesim
