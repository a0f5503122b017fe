// SPDX-License-Identifier: BSD-3-Clause
// Nearest points of links, and the boxes around them.
#include <algorithm>
#include <array>
#include <limits>

#include "bubblesim/world_geometry.hpp"
#include "physics/contacts/convex_geom.hpp"
#include "physics/convex/gjk.hpp"
#include "physics/convex/terrain_contacts.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/world/state.hpp"

namespace bubblesim {
namespace {

bool contains(const std::vector<ObjectId>& links, ObjectId link) {
  return std::find(links.begin(), links.end(), link) != links.end();
}

std::vector<const Collider*> colliders_of(const WorldState& state, const std::vector<ObjectId>& links) {
  std::vector<const Collider*> found;
  for (const auto& model : state.models) {
    for (const Collider& collider : model->colliders) {
      if (contains(links, collider.link->object)) found.push_back(&collider);
    }
  }
  return found;
}

bool is_plane(const Collider& collider) { return dGeomGetClass(collider.geom.get()) == dPlaneClass; }

/// The triangles of a mesh that physics sees as such, as shapes in the world, which are near a box in the mesh's frame.
void add_triangles(const TriangleTree& tree, const Transform& frame, const Bounds& box,
                   std::vector<ConvexShape>& shapes) {
  std::vector<std::uint32_t> near;
  tree.near(box, near);
  for (const std::uint32_t triangle : near) {
    std::array<Vector3, 3> at = tree.corners(triangle);
    for (Vector3& corner : at) corner = frame * corner;
    shapes.emplace_back(at);
  }
}

Bounds everywhere() {
  const Vector3 far = Vector3::Constant(std::numeric_limits<double>::max() / 4);
  return {-far, far};
}

/// The convex shapes of a collider; all triangles of a mesh without parts.
std::vector<ConvexShape> all_shapes(const Collider& collider) {
  std::vector<ConvexShape> shapes;
  shapes_of(collider.geom.get(), shapes);
  if (shapes.empty() && collider.mesh != nullptr) {
    add_triangles(collider.mesh->tree(), geom_transform(collider.geom.get()), everywhere(), shapes);
  }
  return shapes;
}

class Search {
 public:
  explicit Search(double limit) : limit_(limit) {}

  void compare(const Collider& a, const Collider& b) {
    if (is_plane(a) && is_plane(b)) return;
    if (is_plane(b)) {
      with_plane(a, b, false);
    } else if (is_plane(a)) {
      with_plane(b, a, true);
    } else {
      const std::vector<ConvexShape> of_a = all_shapes(a);
      for (const ConvexShape& shape : of_a) {
        for (const ConvexShape& other : near_shapes(shape, b)) measure(shape, other, a, b);
      }
    }
  }

  std::optional<NearestPoints> found() const { return is_found_ ? std::optional(found_) : std::nullopt; }
  /// Nothing can be nearer.
  bool is_done() const { return is_found_ && found_.distance <= 0; }

 private:
  std::vector<ConvexShape> near_shapes(const ConvexShape& shape, const Collider& collider) const {
    std::vector<ConvexShape> shapes;
    shapes_of(collider.geom.get(), shapes);
    if (!shapes.empty() || collider.mesh == nullptr) return shapes;
    const Transform frame = geom_transform(collider.geom.get());
    Bounds box = everywhere();
    if (limit_ < std::numeric_limits<double>::max() / 4) {
      box = bounds_in(shape, frame);
      box.min() -= Vector3::Constant(limit_);
      box.max() += Vector3::Constant(limit_);
    }
    add_triangles(collider.mesh->tree(), frame, box, shapes);
    return shapes;
  }

  void measure(const ConvexShape& shape, const ConvexShape& other, const Collider& a, const Collider& b) {
    if (is_done()) return;
    const double rounding = shape.rounding() + other.rounding();
    const CoreDistance cores = core_distance(shape, other, limit_ + rounding);
    if (cores.overlap) {
      keep(0, other.centre(), other.centre(), a, b);
      return;
    }
    if (cores.distance - rounding > limit_) return;
    const Vector3 direction = (cores.on_b - cores.on_a).normalized();
    if (cores.distance <= rounding) {
      const Vector3 at = cores.on_a + direction * std::min(shape.rounding(), cores.distance);
      keep(0, at, at, a, b);
      return;
    }
    keep(cores.distance - rounding, cores.on_a + direction * shape.rounding(),
         cores.on_b - direction * other.rounding(), a, b);
  }

  void with_plane(const Collider& body, const Collider& plane, bool reversed) {
    dVector4 values;
    dGeomPlaneGetParams(plane.geom.get(), values);
    const Vector3 normal = to_vector(values);
    for (const ConvexShape& shape : all_shapes(body)) {
      const Vector3 lowest = shape.support(-normal) - normal * shape.rounding();
      const double height = lowest.dot(normal) - values[3];
      if (height > limit_) continue;
      const Vector3 below = lowest - normal * std::max(0.0, height);
      if (reversed) {
        keep(std::max(0.0, height), below, lowest, plane, body);
      } else {
        keep(std::max(0.0, height), lowest, below, body, plane);
      }
    }
  }

  void keep(double distance, const Vector3& on_a, const Vector3& on_b, const Collider& a, const Collider& b) {
    if (is_found_ && distance >= limit_) return;
    found_ = NearestPoints{distance, on_a, on_b, a.link->object, b.link->object};
    is_found_ = true;
    limit_ = distance;
  }

  double limit_;
  bool is_found_ = false;  // beside it: GCC 14 warns of an optional that may be without a value
  NearestPoints found_;
};

}  // namespace

std::optional<NearestPoints> WorldGeometry::nearest(const std::vector<ObjectId>& first,
                                                    const std::vector<ObjectId>& second, double limit) const {
  Search search(limit);
  const std::vector<const Collider*> others = colliders_of(state(), second);
  for (const Collider* a : colliders_of(state(), first)) {
    for (const Collider* b : others) {
      if (a->link == b->link || search.is_done()) continue;
      search.compare(*a, *b);
    }
  }
  return search.found();
}

std::optional<std::pair<Vector3, Vector3>> WorldGeometry::bounds(const std::vector<ObjectId>& links,
                                                                 const Pose& frame) const {
  Bounds bounds;
  const Transform axes(frame);
  for (const Collider* collider : colliders_of(state(), links)) {
    if (is_plane(*collider)) return {};
    for (const ConvexShape& shape : all_shapes(*collider)) bounds.extend(bounds_in(shape, axes));
  }
  if (bounds.isEmpty()) return {};
  return std::make_pair(bounds.min(), bounds.max());
}

}  // namespace bubblesim
