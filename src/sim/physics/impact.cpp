// SPDX-License-Identifier: BSD-3-Clause
#include "physics/impact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "physics/convex/convex_geom.hpp"
#include "physics/convex/terrain_contacts.hpp"
#include "physics/world_state.hpp"

namespace bubblesim {
namespace {

// A link may sink in by this part of half its size without being stopped: shapes do not catch on the edges of level
// floors, which they overlap by a millimetre.
constexpr double kShrink = 0.2;

Transform body_transform(dBodyID body) { return frame_of(dBodyGetPosition(body), dBodyGetRotation(body)); }

/// A link that moved far.
struct FastLink {
  PlacedModel* model = nullptr;
  const Link* link = nullptr;
};

/// Finds where the links of a substep first meet other bodies.
class ImpactSearch {
 public:
  ImpactSearch(World::State& state, const std::vector<FastLink>& fast)
      : state_(state), fast_(fast), stopped_(state.moving.size(), 1), probe_(dCreateBox(nullptr, 1, 1, 1)) {}

  /// By moving model: the fraction of the substep at which it is stopped; 1 if it is not.
  const std::vector<double>& find() {
    for (std::size_t i = 0; i < fast_.size(); ++i) {
      for (const Collider& collider : fast_[i].model->colliders) {
        if (collider.link != fast_[i].link) continue;
        find_for(collider);
        for (std::size_t j = i + 1; j < fast_.size(); ++j) {
          for (const Collider& other : fast_[j].model->colliders) {
            if (other.link == fast_[j].link) test(collider, other);
          }
        }
      }
    }
    return stopped_;
  }

 private:
  bool is_fast(const Link* link) const {
    return std::any_of(fast_.begin(), fast_.end(), [&](const FastLink& one) { return one.link == link; });
  }

  static RigidMotion motion_of(const Link& link) {
    if (link.body == nullptr) return {};
    return {link.sweep.start, body_transform(link.body.get())};
  }

  /// Tests a shape with all others in the box of its motion, except fast ones.
  void find_for(const Collider& collider) {
    current_ = &collider;
    dReal box[6];
    dGeomGetAABB(collider.geom.get(), box);
    const RigidMotion motion = motion_of(*collider.link);
    const Vec3 middle{(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2};
    const Vec3 half{(box[1] - box[0]) / 2, (box[3] - box[2]) / 2, (box[5] - box[4]) / 2};
    Bounds swept{middle, middle};
    swept.include(motion.back_to(0).place(middle));
    const double reach = length(half);
    const Vec3 size = swept.high - swept.low + Vec3{2 * reach, 2 * reach, 2 * reach};
    const Vec3 centre = (swept.high + swept.low) * 0.5;
    dGeomBoxSetLengths(probe_.get(), size.x, size.y, size.z);
    dGeomSetPosition(probe_.get(), centre.x, centre.y, centre.z);
    dGeomSetCategoryBits(probe_.get(), dGeomGetCategoryBits(collider.geom.get()));
    dGeomSetCollideBits(probe_.get(), dGeomGetCollideBits(collider.geom.get()));
    swept_ = {centre - size * 0.5, centre + size * 0.5};
    for (dSpaceID space : {state_.movers.get(), state_.statics.get(), state_.planes.get()}) {
      dSpaceCollide2(probe_.get(), reinterpret_cast<dGeomID>(space), this, meet);
    }
  }

  static void meet(void* data, dGeomID first, dGeomID second) {
    auto& search = *static_cast<ImpactSearch*>(data);
    dGeomID other = first == search.probe_.get() ? second : first;
    if (dGeomIsSpace(other) != 0) return dSpaceCollide2(search.probe_.get(), other, data, meet);
    const auto& collider = *static_cast<const Collider*>(dGeomGetData(other));
    if (!search.is_fast(collider.link)) search.test(*search.current_, collider);
  }

  /// As in collision.cpp: shapes that do not touch cannot stop each other.
  static bool may_touch(const Collider& a, const Collider& b) {
    if (a.link == b.link) return false;
    dGeomID geom_a = a.geom.get();
    dGeomID geom_b = b.geom.get();
    if ((dGeomGetCategoryBits(geom_a) & dGeomGetCollideBits(geom_b)) == 0 &&
        (dGeomGetCategoryBits(geom_b) & dGeomGetCollideBits(geom_a)) == 0) {
      return false;
    }
    dBodyID body_b = b.link->body.get();
    return body_b == nullptr || dAreConnectedExcluding(a.link->body.get(), body_b, dJointTypeContact) == 0;
  }

  void test(const Collider& a, const Collider& b) {
    if (!may_touch(a, b)) return;
    if (a.island == b.island && !state_.moving[static_cast<std::size_t>(a.island)]->description.self_collide) return;
    const RigidMotion motion_a = motion_of(*a.link);
    const RigidMotion motion_b = motion_of(*b.link);
    shapes_of(a.geom.get(), shapes_a_);
    list_obstacles(b);
    for (const ConvexShape& shape : shapes_a_) {
      ConvexShape core = shape;
      core.shrink(kShrink * std::min(a.link->sweep.half_size, shape.reach()));
      for (const ConvexShape& obstacle : obstacles_) {
        const std::optional<double> deep = meeting({core, motion_a}, {obstacle, motion_b});
        if (!deep) continue;
        // A shape that overlaps from the start, as a capsule that hit with one end, stops where its core does.
        stop(a, b, meeting({shape, motion_a}, {obstacle, motion_b}).value_or(*deep));
      }
    }
  }

  void stop(const Collider& a, const Collider& b, double fraction) {
    double& at = stopped_[static_cast<std::size_t>(a.island)];
    at = std::min(at, fraction);
    if (!is_fast(b.link)) return;  // a slow body goes on: it sinks in by less than half its size
    double& other = stopped_[static_cast<std::size_t>(b.island)];
    other = std::min(other, fraction);
  }

  /// The convex shapes of a collider near the box of the motion.
  void list_obstacles(const Collider& b) {
    dGeomID geom = b.geom.get();
    obstacles_.clear();
    switch (dGeomGetClass(geom)) {
      case dPlaneClass:
        list_plane(geom);
        break;
      case dTriMeshClass:
        list_triangles(b);
        break;
      default:
        shapes_of(geom, obstacles_);
    }
  }

  /// A plane is a box below it that is larger than the motion.
  void list_plane(dGeomID geom) {
    dVector4 values;
    dGeomPlaneGetParams(geom, values);
    const Vec3 normal{values[0], values[1], values[2]};
    const double size = 2 * length(swept_.high - swept_.low);
    const Vec3 middle = (swept_.high + swept_.low) * 0.5;
    const Vec3 foot = middle - normal * (dot(middle, normal) - values[3]);
    const Vec3 u = across(normal);
    dGeomBoxSetLengths(probe_.get(), size, size, size);
    ConvexShape solid(probe_.get());
    solid.set_frame({foot - normal * (size / 2), u, cross(normal, u), normal});
    obstacles_.push_back(solid);
  }

  void list_triangles(const Collider& b) {
    const Transform frame = frame_of(dGeomGetPosition(b.geom.get()), dGeomGetRotation(b.geom.get()));
    const Transform back = inverse(frame);
    Bounds local{back.place(swept_.low), back.place(swept_.low)};
    for (int i = 1; i < 8; ++i) {
      local.include(
          back.place({(i & 1) != 0 ? swept_.high.x : swept_.low.x, (i & 2) != 0 ? swept_.high.y : swept_.low.y,
                      (i & 4) != 0 ? swept_.high.z : swept_.low.z}));
    }
    near_.clear();
    const TriangleTree& tree = b.mesh->tree();
    tree.near(local, near_);
    for (const std::uint32_t number : near_) {
      std::array<Vec3, 3> corners = tree.corners(number);
      for (Vec3& corner : corners) corner = frame.place(corner);
      obstacles_.emplace_back(corners);
    }
  }

  World::State& state_;
  const std::vector<FastLink>& fast_;
  std::vector<double> stopped_;
  ode::GeomHandle probe_;
  const Collider* current_ = nullptr;
  Bounds swept_;
  std::vector<ConvexShape> shapes_a_;
  std::vector<ConvexShape> obstacles_;
  std::vector<std::uint32_t> near_;
};

/// Puts a model where it was at a fraction of the substep: all its links, so that its joints stay closed.
void put_back(const World::State& state, const PlacedModel& model, double fraction, double step) {
  const Vector3 excess = state.gravity * (step * (1 - fraction));  // of the speed of fall
  for (const Link& link : model.links) {
    dBodyID body = link.body.get();
    const Transform at = RigidMotion(link.sweep.start, body_transform(body)).at(fraction);
    const dMatrix3 rotation = {at.x.x, at.y.x, at.z.x, 0, at.x.y, at.y.y, at.z.y, 0, at.x.z, at.y.z, at.z.z, 0};
    dBodySetPosition(body, at.origin.x, at.origin.y, at.origin.z);
    dBodySetRotation(body, rotation);
    if (dBodyGetGravityMode(body) == 0) continue;
    const dReal* v = dBodyGetLinearVel(body);
    dBodySetLinearVel(body, v[0] - excess.x(), v[1] - excess.y(), v[2] - excess.z());
  }
}

/// Half the smallest size of a shape and its greatest distance from its centre, m.
struct Size {
  double half = Sweep::kNoSize;
  double reach = 0;
};

Size size_of(const Collider& collider) {
  if (collider.mesh != nullptr) {
    Size size;
    for (const ConvexPart& part : collider.mesh->parts) {
      const Vec3 box = part.high - part.low;
      size.half = std::min({size.half, box.x / 2, box.y / 2, box.z / 2});
      size.reach = std::max(size.reach, length(part.centre) + part.reach);
    }
    return size;
  }
  if (const auto* box = std::get_if<Box>(&collider.geometry)) return {box->size.minCoeff() / 2, box->size.norm() / 2};
  if (const auto* sphere = std::get_if<Sphere>(&collider.geometry)) return {sphere->radius, sphere->radius};
  if (const auto* ball = std::get_if<Ellipsoid>(&collider.geometry)) return {ball->radii.x(), ball->radii.x()};
  if (const auto* capsule = std::get_if<Capsule>(&collider.geometry)) {
    return {capsule->radius, capsule->radius + capsule->length / 2};
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&collider.geometry)) {
    return {std::min(cylinder->radius, cylinder->length / 2), std::hypot(cylinder->radius, cylinder->length / 2)};
  }
  return {};
}

}  // namespace

void measure(const Collider& collider, Sweep& sweep) {
  if (collider.given_surface.collide_without_contact) return;
  const Size size = size_of(collider);
  if (size.half == Sweep::kNoSize) return;
  sweep.half_size = std::min(sweep.half_size, size.half);
  const double lever = (collider.in_link.position - collider.link->centre_of_mass).norm();
  sweep.spin_reach = std::max(sweep.spin_reach, lever + size.reach - size.half);
}

void note_motion(World::State& state) {
  for (PlacedModel* model : state.moving) {
    for (Link& link : model->links) {
      link.sweep.start = body_transform(link.body.get());
    }
  }
}

void stop_at_impacts(World::State& state, double step) {
  thread_local std::vector<FastLink> fast;
  fast.clear();
  for (PlacedModel* model : state.moving) {
    for (const Link& link : model->links) {
      const Sweep& sweep = link.sweep;
      if (sweep.half_size == Sweep::kNoSize) continue;
      const dReal* at = dBodyGetPosition(link.body.get());
      const Vec3 travel = Vec3{at[0], at[1], at[2]} - sweep.start.origin;
      const dReal* spin = dBodyGetAngularVel(link.body.get());
      const double turned = length({spin[0], spin[1], spin[2]}) * step * sweep.spin_reach;
      const double left = sweep.half_size - turned;
      if (left < 0 || dot(travel, travel) > left * left) fast.push_back({model, &link});
    }
  }
  if (fast.empty()) return;
  ImpactSearch search(state, fast);
  const std::vector<double>& stopped = search.find();
  for (std::size_t i = 0; i < stopped.size(); ++i) {
    if (stopped[i] < 1) put_back(state, *state.moving[i], stopped[i], step);
  }
}

}  // namespace bubblesim
