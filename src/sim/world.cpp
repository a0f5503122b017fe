// SPDX-License-Identifier: BSD-3-Clause
// The life of a world and how time passes in it; its objects are read and written in world_objects.cpp and
// world_joints.cpp.
#include "bubblesim/world.hpp"

#include <cmath>
#include <utility>

#include "bubblesim/error.hpp"
#include "checks.hpp"
#include "describe.hpp"
#include "fnv1a.hpp"
#include "scene_check.hpp"
#include "world_state.hpp"

namespace bubblesim {
namespace {

void check_bodies(World::State& state) {
  for (const Link& link : state.links) {
    if (link.body == nullptr) continue;
    const Vector3 position = to_vector(dBodyGetPosition(link.body));
    const Vector3 linear = to_vector(dBodyGetLinearVel(link.body));
    const Vector3 angular = to_vector(dBodyGetAngularVel(link.body));
    if (within(position, kMaxDistance) && within(linear, kMaxSpeed) && within(angular, kMaxSpeed)) continue;
    state.diverged = true;
    throw Diverged("the physics diverged at " + state.tree.path(link.object) + ": position " + text(position) +
                   " m, velocity " + text(linear) + " m/s, " + text(angular) +
                   " rad/s; check masses, inertias, forces and overlapping shapes, or take a smaller physics step");
  }
}

/// ODE keeps one random state for the whole process; this puts a world's own in its place for a while.
class OwnRandomState {
 public:
  explicit OwnRandomState(unsigned long& own) : own_(own), others_(dRandGetSeed()) { dRandSetSeed(own_); }
  ~OwnRandomState() {
    own_ = dRandGetSeed();
    dRandSetSeed(others_);
  }
  OwnRandomState(const OwnRandomState&) = delete;
  OwnRandomState& operator=(const OwnRandomState&) = delete;

 private:
  unsigned long& own_;
  unsigned long others_;
};

}  // namespace

World::State::State() { ode::prepare_this_thread(); }

World::State::~State() {
  if (!diverged) return;
  // ODE may have been left in the middle of a step with its spaces locked; taking them down would trip its assertions.
  static_cast<void>(contacts.release());
  static_cast<void>(movers.release());
  static_cast<void>(statics.release());
  static_cast<void>(planes.release());
  static_cast<void>(world.release());
  static_cast<void>(threading.release());
}

World::World(const SceneDescription& scene, std::uint64_t seed) : state_(std::make_unique<State>()) {
  std::vector<Problem> problems = check_scene(scene);
  if (!problems.empty()) throw SceneError(std::move(problems));
  state_->random_state = static_cast<unsigned long>(seed);
  build_world(*state_, scene);
}

World::~World() = default;

const SceneTree& World::tree() const { return state_->tree; }

void World::advance(double duration, double step) {
  if (!(step > 0) || !within(duration, 1e3)) throw InvalidInput("a physics step of " + text(step) + " s is not usable");
  if (state_->diverged) throw Diverged("the physics diverged earlier; load the scene again");
  ode::prepare_this_thread();
  const OwnRandomState random(state_->random_state);
  try {
    for (long left = std::lround(duration / step); left > 0; --left) {
      find_contacts(*state_);
      for (const PlacedJoint& placed : state_->joints) {
        if (placed.joint) placed.joint->drive(step);
      }
      dWorldStep(state_->world.get(), step);
      check_bodies(*state_);
    }
  } catch (const Diverged&) {
    state_->diverged = true;
    throw;
  }
}

std::vector<PlacedShape> World::shapes() const {
  std::vector<PlacedShape> shapes;
  for (const Collider& collider : state_->colliders) {
    shapes.push_back({collider.link, state_->link(collider.link).body == nullptr, collider.geometry,
                      state_->link_pose(collider.link) * collider.in_link});
  }
  return shapes;
}

std::uint64_t World::state_hash() const {
  Fnv1a hash;
  for (const Link& link : state_->links) {
    if (link.body == nullptr) continue;
    hash.add(dBodyGetPosition(link.body), 3);
    hash.add(dBodyGetQuaternion(link.body), 4);
    hash.add(dBodyGetLinearVel(link.body), 3);
    hash.add(dBodyGetAngularVel(link.body), 3);
  }
  for (const PlacedJoint& placed : state_->joints) {
    for (int axis = 0; placed.joint && axis < placed.joint->axis_count(); ++axis) {
      const double targets[] = {placed.joint->target_position(axis), placed.joint->target_velocity(axis),
                                placed.joint->axis(axis).max_force};
      hash.add(targets, 3);
    }
  }
  hash.add(static_cast<std::uint64_t>(state_->random_state));
  return hash.value();
}

}  // namespace bubblesim
