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

constexpr double kMaxDuration = 1000;  // s, of one call

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

}  // namespace

World::State::State() { ode::prepare_this_thread(); }

World::State::~State() {
  if (!interrupted) return;
  // ODE was left in the middle of a step, perhaps with its spaces locked; taking them down would trip its assertions.
  static_cast<void>(contacts.release());
  static_cast<void>(movers.release());
  static_cast<void>(statics.release());
  static_cast<void>(planes.release());
  static_cast<void>(world.release());
  static_cast<void>(threading.release());
}

World::World(const SceneDescription& scene, std::uint64_t seed) : scene_(scene), seed_(seed) {
  std::vector<Problem> problems = check_scene(scene_);
  if (!problems.empty()) throw SceneError(std::move(problems));
  build();
}

World::~World() = default;

void World::build() {
  auto built = std::make_unique<State>();
  built->seed = seed_;
  build_world(*built, scene_);
  state_ = std::move(built);
}

// Built anew, for ODE keeps more of the past than poses and velocities: forces of the last step, the order of its
// lists.
void World::reset() { build(); }

const SceneTree& World::tree() const { return state_->tree; }

void World::advance(double duration, double step) {
  if (!(step >= kMinPhysicsStep && step <= kMaxPhysicsStep)) {
    throw InvalidInput("a physics step of " + text(step) + " s is not usable: it must be from 1e-5 to 1 s");
  }
  if (!(duration >= 0 && duration <= kMaxDuration)) {
    throw InvalidInput("a duration of " + text(duration) + " s is not usable: it must be from 0 to 1000 s");
  }
  if (state_->diverged) throw Diverged("the physics diverged earlier; reset the world or load the scene again");
  ode::prepare_this_thread();
  for (long left = std::lround(duration / step); left > 0; --left) {
    try {
      find_contacts(*state_);
      for (const PlacedJoint& placed : state_->joints) {
        if (placed.joint) placed.joint->drive(step);
      }
      // Draws no random numbers, unlike dWorldQuickStep: ODE keeps one random state for all worlds and threads.
      dWorldStep(state_->world.get(), step);
    } catch (const Diverged&) {
      state_->diverged = state_->interrupted = true;
      throw;
    }
    check_bodies(*state_);
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
  hash.add(state_->seed);
  return hash.value();
}

}  // namespace bubblesim
