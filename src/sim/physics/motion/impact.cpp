// SPDX-License-Identifier: BSD-3-Clause
#include "physics/motion/impact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "physics/contacts/convex_geom.hpp"
#include "physics/convex/swept.hpp"
#include "physics/convex/terrain_contacts.hpp"
#include "physics/ode/ode_math.hpp"

namespace bubblesim {
namespace {

// A link may sink in by this part of half its size without being stopped: shapes do not catch on the edges of level
// floors, which they overlap by a millimetre.
constexpr double kShrink = 0.2;

/// A link that moved far.
struct FastLink {
  PlacedModel* model = nullptr;
  const Link* link = nullptr;
};

/// Finds where the links of a substep first meet other bodies.
class ImpactSearch {
 public:
  ImpactSearch(const Substep& substep, const std::vector<FastLink>& fast)
      : moving_(substep.moving),
        spaces_(substep.spaces),
        fast_(fast),
        stopped_(substep.moving.all.size(), 1),
        probe_(dCreateBox(nullptr, 1, 1, 1)) {}

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

  static SweptMotion motion_of(const Link& link) {
    if (link.body == nullptr) return {};
    return {link.sweep.start, body_transform(link.body.get())};
  }

  /// Tests a shape with all others in the box of its motion, except fast ones.
  void find_for(const Collider& collider) {
    current_ = &collider;
    const SweptMotion motion = motion_of(*collider.link);
    const Bounds own = box_of(collider.geom.get());
    const Vector3 middle = own.center();
    const Bounds centres = Bounds(middle).extend(motion.back_to(0) * middle);
    const Vector3 size = centres.sizes() + Vector3::Constant(own.diagonal().norm());
    const Vector3 centre = centres.center();
    dGeomBoxSetLengths(probe_.get(), size.x(), size.y(), size.z());
    dGeomSetPosition(probe_.get(), centre.x(), centre.y(), centre.z());
    dGeomSetCategoryBits(probe_.get(), dGeomGetCategoryBits(collider.geom.get()));
    dGeomSetCollideBits(probe_.get(), dGeomGetCollideBits(collider.geom.get()));
    swept_ = Bounds(centre - size / 2, centre + size / 2);
    for (dSpaceID space : {spaces_.movers.get(), spaces_.sleepers.get(), spaces_.statics.get(), spaces_.planes.get()}) {
      if (space != nullptr) dSpaceCollide2(probe_.get(), reinterpret_cast<dGeomID>(space), this, meet);
    }
  }

  static void meet(void* data, dGeomID first, dGeomID second) {
    auto& search = *static_cast<ImpactSearch*>(data);
    dGeomID other = first == search.probe_.get() ? second : first;
    if (dGeomIsSpace(other) != 0) return dSpaceCollide2(search.probe_.get(), other, data, meet);
    const Collider& collider = collider_of(other);
    if (!search.is_fast(collider.link)) search.test(*search.current_, collider);
  }

  /// As in collision.cpp: shapes that do not touch cannot stop each other.
  static bool may_touch(const Collider& a, const Collider& b) {
    if (a.link == b.link || !share_bits(a, b)) return false;
    dBodyID body_b = b.link->body.get();
    return body_b == nullptr || dAreConnectedExcluding(a.link->body.get(), body_b, dJointTypeContact) == 0;
  }

  void test(const Collider& a, const Collider& b) {
    if (!may_touch(a, b)) return;
    if (a.model == b.model && !moving_.at(a.model).description.self_collide) return;
    const SweptMotion motion_a = motion_of(*a.link);
    const SweptMotion motion_b = motion_of(*b.link);
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
    double& at = stopped_[static_cast<std::size_t>(a.model)];
    at = std::min(at, fraction);
    if (!is_fast(b.link)) return;  // a slow body goes on: it sinks in by less than half its size
    double& other = stopped_[static_cast<std::size_t>(b.model)];
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
    const Vector3 normal = to_vector(values);
    const double size = 2 * swept_.diagonal().norm();
    const Vector3 middle = swept_.center();
    const Vector3 foot = middle - normal * (middle.dot(normal) - values[3]);
    dGeomBoxSetLengths(probe_.get(), size, size, size);
    ConvexShape solid(probe_.get());
    solid.set_frame({foot - normal * (size / 2), turn_from_z(normal).toRotationMatrix()});
    obstacles_.push_back(solid);
  }

  void list_triangles(const Collider& b) {
    const Transform frame = geom_transform(b.geom.get());
    const Transform back = frame.inverse();
    Bounds local;
    for (int i = 0; i < 8; ++i) local.extend(back * swept_.corner(static_cast<Bounds::CornerType>(i)));
    near_.clear();
    const TriangleTree& tree = b.mesh->tree();
    tree.near(local, near_);
    for (const std::uint32_t number : near_) {
      std::array<Vector3, 3> corners = tree.corners(number);
      for (Vector3& corner : corners) corner = frame * corner;
      obstacles_.emplace_back(corners);
    }
  }

  const MovingModels& moving_;
  const Spaces& spaces_;
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
void put_back(const PlacedModel& model, const Vector3& gravity, double fraction, double step) {
  const Vector3 excess = gravity * (step * (1 - fraction));  // of the speed of fall
  for (const Link& link : model.links) {
    dBodyID body = link.body.get();
    const Transform at = SweptMotion(link.sweep.start, body_transform(body)).at(fraction);
    dMatrix3 rotation = {};
    Eigen::Map<Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>>(rotation).leftCols<3>() = at.rotation;
    dBodySetPosition(body, at.position.x(), at.position.y(), at.position.z());
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
      const Vector3 box = part.high - part.low;
      size.half = std::min(size.half, box.minCoeff() / 2);
      size.reach = std::max(size.reach, part.centre.norm() + part.reach);
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

void note_motion(const MovingModels& moving) {
  for (PlacedModel* model : moving.awake) {
    for (Link& link : model->links) {
      link.sweep.start = body_transform(link.body.get());
    }
  }
}

void stop_at_impacts(Substep& substep) {
  thread_local std::vector<FastLink> fast;
  fast.clear();
  for (PlacedModel* model : substep.moving.awake) {
    for (const Link& link : model->links) {
      const Sweep& sweep = link.sweep;
      if (sweep.half_size == Sweep::kNoSize) continue;
      const Vector3 travel = to_vector(dBodyGetPosition(link.body.get())) - sweep.start.position;
      const double turned = to_vector(dBodyGetAngularVel(link.body.get())).norm() * substep.duration * sweep.spin_reach;
      const double left = sweep.half_size - turned;
      if (left < 0 || travel.squaredNorm() > left * left) fast.push_back({model, &link});
    }
  }
  if (fast.empty()) return;
  ImpactSearch search(substep, fast);
  const std::vector<double>& stopped = search.find();
  for (std::size_t i = 0; i < stopped.size(); ++i) {
    if (stopped[i] < 1) put_back(*substep.moving.all[i], substep.gravity, stopped[i], substep.duration);
  }
}

}  // namespace bubblesim
