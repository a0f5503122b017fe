// SPDX-License-Identifier: BSD-3-Clause
#include "physics/motion/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "physics/ode/ode_math.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

constexpr double kTime = 0.5;            // s at rest before an island sleeps
constexpr double kDrift = 3e-3 * kTime;  // m, which a body at rest stays within in this time
constexpr double kAngle = 3e-3 * kTime;  // rad, likewise

void wake_model(PlacedModel& model) {
  model.rest.group = kNoObject;
  model.rest.time = 0;
  for (const Link& link : model.links) dBodyEnable(link.body.get());
}

void wake_group(const MovingModels& moving, ObjectId group) {
  for (PlacedModel* model : moving.all) {
    if (model->rest.group == group) wake_model(*model);
  }
}

bool has_stayed(const Link& link) {
  const Pose now = body_pose(link.body.get());
  const double cosine = now.orientation.dot(link.rest_pose.orientation);  // of half the angle between them
  return (now.position - link.rest_pose.position).norm() < kDrift && std::abs(cosine) > std::cos(kAngle / 2);
}

void measure(PlacedModel& model, double step) {
  model.rest.time += step;
  if (std::all_of(model.links.begin(), model.links.end(), has_stayed)) return;
  model.rest.time = 0;
  for (Link& link : model.links) link.rest_pose = body_pose(link.body.get());
}

void put_to_sleep(PlacedModel& model, ObjectId group) {
  model.rest.group = group;
  for (Link& link : model.links) {
    dBodySetLinearVel(link.body.get(), 0, 0, 0);
    dBodySetAngularVel(link.body.get(), 0, 0, 0);
    dBodyDisable(link.body.get());
    // What is noted of awake models at the start of an advance and of a substep.
    link.before = {};
    link.sweep.start = body_transform(link.body.get());
  }
}

}  // namespace

void command(MovingModels& moving, dBodyID body) {
  if (dBodyIsEnabled(body) != 0) return;
  dBodyEnable(body);
  moving.is_any_commanded = true;
}

void wake_commanded(Substep& substep) {
  MovingModels& moving = substep.moving;
  if (!std::exchange(moving.is_any_commanded, false)) return;
  for (const PlacedModel* model : moving.all) {
    const auto is_enabled = [](const Link& link) { return dBodyIsEnabled(link.body.get()) != 0; };
    if (!model->rest.is_awake() && std::any_of(model->links.begin(), model->links.end(), is_enabled)) {
      wake_group(moving, model->rest.group);
    }
  }
  sort_by_sleep(moving, substep.spaces, substep.contacts);
}

bool wake_touched(Substep& substep) {
  const MovingModels& moving = substep.moving;
  bool any = false;
  for (const FoundPair& pair : substep.contacts.found.pairs) {
    for (const Collider* shape : {pair.first, pair.second}) {
      // One shape of a pair is of a model that is awake.
      if (shape->model == Collider::kNoModel || moving.at(shape->model).rest.is_awake()) continue;
      wake_group(moving, moving.at(shape->model).rest.group);
      any = true;
    }
  }
  if (any) sort_by_sleep(substep.moving, substep.spaces, substep.contacts);
  return any;
}

void rest(Substep& substep) {
  MovingModels& moving = substep.moving;
  Islands& islands = substep.contacts.islands;
  const auto island_of = [&](const PlacedModel& model) { return static_cast<std::size_t>(islands.of(model.number)); };
  struct RestOfIsland {
    double time = std::numeric_limits<double>::infinity();  // s, of the model that moved last
    ObjectId group = kNoObject;                             // when it goes to sleep
  };
  thread_local std::vector<RestOfIsland> rests;
  rests.resize(moving.all.size());
  for (const PlacedModel* model : moving.awake) rests[island_of(*model)] = {};
  for (PlacedModel* model : moving.awake) {
    if (model->rest.may_sleep) measure(*model, substep.duration);
    double& time = rests[island_of(*model)].time;
    time = std::min(time, model->rest.may_sleep ? model->rest.time : 0);
  }
  bool any = false;
  for (PlacedModel* model : moving.awake) {
    RestOfIsland& island = rests[island_of(*model)];
    if (island.time < kTime) continue;
    if (island.group == kNoObject) island.group = model->object;
    put_to_sleep(*model, island.group);
    any = true;
  }
  if (any) sort_by_sleep(moving, substep.spaces, substep.contacts);
}

void wake(MovingModels& moving, Spaces& spaces, Contacts& contacts) {
  const bool any_sleeps = moving.awake.size() < moving.all.size();
  for (PlacedModel* model : moving.all) wake_model(*model);
  if (any_sleeps) sort_by_sleep(moving, spaces, contacts);
}

void sort_by_sleep(MovingModels& moving, Spaces& spaces, Contacts& contacts) {
  moving.awake.clear();
  ++spaces.changes;
  for (PlacedModel* model : moving.all) {
    if (model->rest.is_awake()) moving.awake.push_back(model);
    dSpaceID space = (model->rest.is_awake() ? spaces.movers : spaces.sleepers).get();
    dGeomID shapes = reinterpret_cast<dGeomID>(model->space.get());
    if (dGeomGetSpace(shapes) == space) continue;
    dSpaceRemove(dGeomGetSpace(shapes), shapes);
    dSpaceAdd(space, shapes);
  }
  sort_by_sleep(contacts.memory, contacts.asleep);
}

void add_rest(Fnv1a& hash, const PlacedModel& model) {
  if (!model.rest.may_sleep) return;
  hash.add(&model.rest.time, 1);
  hash.add(static_cast<std::uint64_t>(model.rest.group));
  for (const Link& link : model.links) {
    const Vector3& p = link.rest_pose.position;
    const Quaternion& q = link.rest_pose.orientation;
    const double values[] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
    hash.add(values, 7);
  }
}

}  // namespace bubblesim
