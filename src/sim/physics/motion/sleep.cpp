// SPDX-License-Identifier: BSD-3-Clause
#include "physics/motion/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "physics/ode/ode_math.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

constexpr double kTime = 0.5;            // s at rest before an island sleeps
constexpr double kDrift = 3e-3 * kTime;  // m, which a body at rest stays within in this time
constexpr double kAngle = 3e-3 * kTime;  // rad, likewise

bool is_awake(const Link& link) { return dBodyIsEnabled(link.body.get()) != 0; }

void wake_model(PlacedModel& model) {
  model.rest.group = kNoObject;
  model.rest.time = 0;
  for (const Link& link : model.links) dBodyEnable(link.body.get());
}

void wake_group(const MovingModels& moving, ObjectId group) {
  for (PlacedModel* model : moving) {
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
  for (const Link& link : model.links) {
    dBodySetLinearVel(link.body.get(), 0, 0, 0);
    dBodySetAngularVel(link.body.get(), 0, 0, 0);
    dBodyDisable(link.body.get());
  }
}

}  // namespace

void wake_commanded(const MovingModels& moving) {
  for (const PlacedModel* model : moving) {
    if (model->rest.group != kNoObject && std::any_of(model->links.begin(), model->links.end(), is_awake)) {
      wake_group(moving, model->rest.group);
    }
  }
}

bool wake_touched(const MovingModels& moving, const FoundContacts& found) {
  bool any = false;
  for (const FoundPair& pair : found.pairs) {
    for (const Collider* shape : {pair.first, pair.second}) {
      // Pairs of sleeping and static shapes are not searched: the other one is awake.
      if (shape->model == Collider::kNoModel) continue;
      const ObjectId group = moving[static_cast<std::size_t>(shape->model)]->rest.group;
      if (group == kNoObject) continue;
      wake_group(moving, group);
      any = true;
    }
  }
  return any;
}

void rest(Substep& substep) {
  const MovingModels& moving = substep.moving;
  Islands& islands = substep.contacts.islands;
  const std::size_t count = moving.size();
  thread_local std::vector<double> least;  // s, by island
  least.assign(count, std::numeric_limits<double>::infinity());
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    PlacedModel& model = *moving[i];
    if (model.rest.group != kNoObject) continue;
    if (model.rest.may_sleep) measure(model, substep.duration);
    double& time = least[static_cast<std::size_t>(islands.of(static_cast<int>(i)))];
    time = std::min(time, model.rest.may_sleep ? model.rest.time : 0);
    any = any || model.rest.time >= kTime;
  }
  if (!any) return;
  std::vector<ObjectId> groups(count, kNoObject);
  for (std::size_t i = 0; i < count; ++i) {
    PlacedModel& model = *moving[i];
    const auto island = static_cast<std::size_t>(islands.of(static_cast<int>(i)));
    if (model.rest.group != kNoObject || least[island] < kTime) continue;
    if (groups[island] == kNoObject) groups[island] = model.object;
    put_to_sleep(model, groups[island]);
  }
}

void wake(const MovingModels& moving) {
  for (PlacedModel* model : moving) wake_model(*model);
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
