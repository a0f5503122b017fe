// SPDX-License-Identifier: BSD-3-Clause
// Advances time in a world, and detects divergence.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "physics/contacts/collision.hpp"
#include "physics/contacts/contact_joints.hpp"
#include "physics/motion/impact.hpp"
#include "physics/motion/joint_correction.hpp"
#include "physics/motion/sleep.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

constexpr double kMaxDuration = 1000;  // s, of one call
constexpr std::size_t kRememberedSteps = 10;

bool is_finite(dBodyID body) {
  return within(to_vector(dBodyGetPosition(body)), kMaxDistance) &&
         within(to_vector(dBodyGetLinearVel(body)), kMaxSpeed) &&
         within(to_vector(dBodyGetAngularVel(body)), kMaxSpeed);
}

void check_bodies(WorldState& state) {
  const Link* first = nullptr;
  for (const PlacedModel* model : state.moving.awake) {
    for (const Link& link : model->links) {
      if (is_finite(link.body.get())) continue;
      if (first == nullptr) first = &link;
      const ObjectId id = state.tree().outermost_model_of(link.object);
      if (state.lost_models.empty() || state.lost_models.back() != id) state.lost_models.push_back(id);
    }
  }
  if (first == nullptr) return;
  state.diverged = true;
  dBodyID body = first->body.get();
  const Twist velocity = body_velocity(body);
  throw Diverged("the physics diverged at " + state.tree().path(first->object) + ": position " +
                 text(to_vector(dBodyGetPosition(body))) + " m, velocity " + text(velocity.linear) + " m/s, " +
                 text(velocity.angular) +
                 " rad/s; check masses, inertias, forces and overlapping shapes, or use a smaller physics substep");
}

/// Searches contacts, and wakes what awake bodies touch.
void find_contacts(Substep& substep) {
  search_contacts(substep);
  while (wake_touched(substep)) search_contacts(substep);
  order_contacts(substep.contacts);
  if (substep.solver == Solver::kBubblesim) TreeSolver::choose(substep);
}

void drive_joints(const MovingModels& moving, double step) {
  for (const PlacedModel* model : moving.awake) {
    for (const PlacedJoint& placed : model->joints) {
      if (placed.joint) placed.joint->drive(step);
    }
  }
}

template <class Do>
void for_each_of_ode(Substep& substep, const Do& act) {
  Islands& islands = substep.contacts.islands;
  for (PlacedModel* model : substep.moving.awake) {
    if (!islands.is_by_trees(islands.of(model->number))) act(*model);
  }
}

/// Rotates the bodies of ODE with unequal moments of inertia: call before and after ODE's step.
void begin_rotations(Substep& substep) {
  for_each_of_ode(substep, [&](PlacedModel& model) {
    for (Rotation& rotation : model.rotations) rotation.begin(substep.duration);
  });
}

void end_rotations(Substep& substep) {
  for_each_of_ode(substep, [&](PlacedModel& model) {
    for (Rotation& rotation : model.rotations) rotation.end(substep.duration);
  });
}

template <class Do>
void for_each_motor_of_ode(Substep& substep, const Do& act) {
  for_each_of_ode(substep, [&](PlacedModel& model) {
    for (const PlacedJoint& placed : model.joints) {
      for (std::size_t axis = 0; axis < placed.motor_meters.size(); ++axis) {
        if (placed.joint->is_driven(static_cast<int>(axis))) act(*placed.motor_meters[axis]);
      }
    }
  });
}

/// Measures ODE's motors, while the bodies are where they were before the substep; and after it. Trees report efforts.
void begin_motor_meters(Substep& substep) {
  for_each_motor_of_ode(substep, [](MotorMeter& meter) { meter.aim(); });
}

void end_motor_meters(Substep& substep) {
  for_each_motor_of_ode(substep, [&](MotorMeter& meter) { meter.gather(substep.duration); });
}

void begin_meters(const MovingModels& moving) {
  for (PlacedModel* model : moving.awake) {
    for (auto& [index, meter] : model->motion_meters) meter.begin();
    for (const PlacedJoint& placed : model->joints) {
      if (placed.meter != nullptr) placed.meter->begin();
    }
  }
}

void end_meters(Substep& substep) {
  Islands& islands = substep.contacts.islands;
  for (PlacedModel* model : substep.moving.awake) {
    const bool is_by_trees = islands.is_by_trees(islands.of(model->number));
    const ForcePlace place = is_by_trees ? ForcePlace::kOnTheWay : ForcePlace::kStart;
    for (auto& [index, meter] : model->motion_meters) meter.end(substep.duration, substep.gravity, place);
    for (const PlacedJoint& placed : model->joints) {
      if (placed.meter != nullptr) placed.meter->end(substep.duration);
    }
  }
}

void simulate(WorldState& state, const Wrenches& wrenches, double step) {
  MovingModels& moving = state.moving;
  Substep substep{step, state.gravity, moving, state.spaces, state.ode, state.contacts, state.holds, state.solver};
  try {
    push_links(state, wrenches);
    for (const DeviceSlot& slot : state.devices) push_links(state, slot.wrenches);
    wake_commanded(substep);
    find_contacts(substep);
    drive_joints(moving, step);
    begin_meters(moving);
    note_motion(moving);
    correct_joints(moving, state.ode.id(), step);
    state.solvers.solve_trees(substep);
    join_contacts(substep);
    begin_motor_meters(substep);
    begin_rotations(substep);
    state.solvers.solve_rest(substep);
    end_rotations(substep);
    end_motor_meters(substep);
    stop_at_impacts(substep);
    gather_contacts(state.contacts);
    rest(substep);
    state.touches.add(state.contacts.found, step);
    end_meters(substep);
  } catch (const Diverged&) {
    state.diverged = state.interrupted = true;
    throw;
  }
  check_bodies(state);
}

/// Records the current states of the models that are awake, for the report of a divergence.
void remember(WorldState& state, double duration) {
  std::vector<StateSample>& history = state.history;
  if (history.size() < kRememberedSteps) {
    history.emplace_back();
  } else {
    std::rotate(history.begin(), history.begin() + 1, history.end());  // keeps the memory of the oldest one
  }
  StateSample& now = history.back();
  now.time = state.age;
  now.links.clear();
  for (PlacedModel* model : state.moving.awake) {
    for (Link& link : model->links) {
      link.before = body_velocity(link.body.get());
      now.links.push_back({link.object, body_pose(link.body.get()), link.before});
    }
  }
  state.last_duration = duration;
}

}  // namespace

void World::advance(double duration, double step, std::optional<double> time) {
  if (!(step >= kMinPhysicsStep && step <= kMaxPhysicsStep)) {
    throw InvalidInput("a physics substep of " + text(step) + " s is not usable: it must be from 1e-5 to 1 s");
  }
  if (!(duration >= 0 && duration <= kMaxDuration)) {
    throw InvalidInput("a duration of " + text(duration) + " s is not usable: it must be from 0 to 1000 s");
  }
  check_not_diverged(*state_);
  ode::prepare_this_thread();
  remember(*state_, duration);
  clear_meters(*state_);
  const Wrenches wrenches = std::exchange(state_->wrenches, {});
  const double start = time.value_or(state_->age);
  const long substeps = std::lround(duration / step);
  for (long done = 0; done < substeps; ++done) {
    update_devices(*this, *state_, start + static_cast<double>(done) * step, step);
    simulate(*state_, wrenches, step);
    carry_statics(*state_);
  }
  move_kinematic_joints(*state_, duration);
  dWorldCleanupWorkingMemory(state_->ode.id());  // a third of the memory of a small world, for one of many
  state_->age += duration;
}

const std::vector<ObjectId>& World::diverged_models() const { return state_->lost_models; }

std::vector<ObjectId> World::fallen_models() const {
  std::vector<ObjectId> fallen;
  const Vector3 down = state_->gravity.normalized();
  if (down == Vector3::Zero()) return fallen;
  for (const PlacedModel* model : state_->moving.awake) {  // those that sleep lie on something
    const bool all_below = std::all_of(model->links.begin(), model->links.end(), [&](const Link& link) {
      return to_vector(dBodyGetPosition(link.body.get())).dot(down) > state_->bottom + kFall;
    });
    if (all_below) fallen.push_back(model->object);
  }
  return fallen;
}

void World::write_last_states(std::ostream& out) const {
  out << "time,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
  for (const StateSample& sample : state_->history) {
    for (const LinkState& link : sample.links) {
      if (!state_->tree().contains(link.object)) continue;
      const Vector3& p = link.pose.position;
      const Quaternion& q = link.pose.orientation;
      const Vector3& v = link.velocity.linear;
      const Vector3& w = link.velocity.angular;
      out << sample.time << ',' << state_->tree().path(link.object);
      for (const double value :
           {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z()}) {
        out << ',' << value;
      }
      out << '\n';
    }
  }
}

}  // namespace bubblesim
