// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/grasp.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "bubblesim/state_archive.hpp"
#include "devices/link_bodies.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

constexpr double kLeastRatio = 0.3;  // of two opposing forces, as in gazebo_grasp_plugin

/// What the fingers do to one link.
struct Touched {
  int points = 0;
  std::map<ObjectId, Vector3> forces;  // N, by finger
};

/// Whether two forces enclose an angle of at least `angle`, and are about as strong.
bool oppose(const Vector3& a, const Vector3& b, double angle) {
  const double shorter = std::min(a.norm(), b.norm());
  const double longer = std::max(a.norm(), b.norm());
  if (!(shorter > 0) || shorter < kLeastRatio * longer) return false;
  return a.dot(b) <= std::cos(angle) * shorter * longer;
}

bool any_oppose(const std::map<ObjectId, Vector3>& forces, double angle) {
  for (auto a = forces.begin(); a != forces.end(); ++a) {
    for (auto b = std::next(a); b != forces.end(); ++b) {
      if (oppose(a->second, b->second, angle)) return true;
    }
  }
  return false;
}

void require(bool fine, const std::string& what) {
  if (!fine) throw InvalidInput("a gripper needs " + what);
}

}  // namespace

Grasp::Grasp(const World& world, GraspDescription description) : description_(std::move(description)) {
  const GraspDescription& d = description_;
  link_description(world, d.palm);
  for (const ObjectId finger : d.fingers) link_description(world, finger);
  require(!d.fingers.empty(), "a finger: a link that presses the object");
  require(d.min_contacts >= 1, "at least 1 contact, not " + std::to_string(d.min_contacts));
  require(d.attach_updates >= 0 && d.detach_updates >= 0, "numbers of updates of 0 or more");
  require(!d.min_angle || (*d.min_angle >= 0 && *d.min_angle <= M_PI), "an angle of forces from 0 to pi");
  require(!d.slack || (std::isfinite(*d.slack) && *d.slack >= 0), "a tolerance of 0 or more, m");
  model_ = world.tree().outermost_model_of(d.palm);
}

/// The link that is pressed: the attached one if it is, or that with the most contact points.
ObjectId Grasp::pressed(const World& world) const {
  const std::vector<ObjectId>& fingers = description_.fingers;
  const auto is_finger = [&](ObjectId link) {
    const bool is_held_by = attachment_ != 0 && link == description_.palm;
    return !is_held_by && std::find(fingers.begin(), fingers.end(), link) != fingers.end();
  };
  std::map<ObjectId, Touched> touched;
  for (const TouchPoint& point : world.measurements().contact_points()) {
    const bool is_first = is_finger(point.first);
    const ObjectId finger = is_first ? point.first : point.second;
    const ObjectId object = is_first ? point.second : point.first;
    if (!is_finger(finger) || world.tree().outermost_model_of(object) == model_) continue;
    if (world.models().description(object).is_static) continue;
    Touched& found = touched[object];
    ++found.points;
    found.forces.try_emplace(finger, Vector3()).first->second += is_first ? Vector3(-point.force) : point.force;
  }
  const std::size_t least_fingers = fingers.size() > 1 && attachment_ == 0 ? 2 : 1;
  ObjectId best = kNoObject;
  for (const auto& [object, found] : touched) {
    if (found.points < description_.min_contacts || found.forces.size() < least_fingers) continue;
    if (description_.min_angle && !any_oppose(found.forces, *description_.min_angle)) continue;
    if (attachment_ != 0 && object == object_) return object;
    if (best == kNoObject || found.points > touched[best].points) best = object;
  }
  return best;
}

void Grasp::attach(World& world) {
  attachment_ = world.attachments().attach(description_.palm, object_);
  missed_ = 0;
  presses_.clear();
  for (const TouchPoint& point : world.measurements().contact_points()) {
    for (const ObjectId finger : description_.fingers) {
      const bool presses =
          (point.first == finger && point.second == object_) || (point.second == finger && point.first == object_);
      if (!presses) continue;
      presses_.push_back(
          {finger, world.pose(finger).inverse() * point.position, world.pose(object_).inverse() * point.position});
    }
  }
}

/// Whether a finger has moved away from where it pressed the object.
bool Grasp::has_opened(const World& world) const {
  if (!description_.slack) return true;
  return std::any_of(presses_.begin(), presses_.end(), [&](const Press& press) {
    const Vector3 on_finger = world.pose(press.finger) * press.in_finger;
    return (on_finger - world.pose(object_) * press.in_object).norm() > *description_.slack;
  });
}

void Grasp::update(World& world, double /*time*/, double /*duration*/) {
  const bool has_ended = attachment_ != 0 && !world.attachments().contains(attachment_);
  if (has_ended) reset(world);  // its model was removed
  const ObjectId found = pressed(world);
  if (attachment_ != 0) {
    missed_ = found == object_ ? 0 : missed_ + 1;
    if (missed_ <= description_.detach_updates || !has_opened(world)) return;
    world.attachments().detach(attachment_);
    reset(world);
    return;
  }
  if (found == kNoObject) {
    held_ = std::max(held_ - 1, 0);
    return;
  }
  held_ = found == object_ ? held_ + 1 : 1;
  object_ = found;
  if (held_ > description_.attach_updates) attach(world);
}

void Grasp::reset(World& /*world*/) {
  object_ = kNoObject;
  held_ = missed_ = 0;
  attachment_ = 0;
  presses_.clear();
}

void Grasp::transfer(StateArchive& archive) { archive(object_, held_, missed_, attachment_, presses_); }

}  // namespace bubblesim
