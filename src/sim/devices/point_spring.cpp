// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/point_spring.hpp"

#include <algorithm>
#include <cmath>

#include "bubblesim/error.hpp"
#include "bubblesim/state_archive.hpp"

namespace bubblesim {
namespace {

constexpr double kFrequency = 2 * 3.14159265358979 * 1.5;  // rad/s
constexpr double kMostForce = 50;                          // N/kg
constexpr double kMostDamping = 0.4;  // of a link's momentum in one update: more overshoots on a light link

}  // namespace

void PointSpring::grip(const World& world, ObjectId link, const Vector3& point) {
  const SceneTree& tree = world.tree();
  const ModelDescription& model = world.models().description(link);
  if (tree.at(link).kind != ObjectKind::kLink || model.is_static) {
    throw WrongObject(tree.short_path(link) + " is not a link of a moving model");
  }
  if (!point.allFinite()) throw InvalidInput("the point that a spring pulls must be finite");
  mass_ = 0;
  for (const LinkDescription& each : model.links) mass_ += each.mass;
  link_mass_ = model.links[tree.at(link).index].mass;
  const Pose pose = world.pose(link);
  point_ = point;
  target_ = pose.position + pose.orientation * point;
  link_ = link;
}

void PointSpring::pull_to(const Vector3& target) {
  if (!target.allFinite()) throw InvalidInput("the place that a spring pulls to must be finite");
  target_ = target;
}

void PointSpring::update(World& world, double /*time*/, double duration) {
  if (link_ == kNoObject) return;
  if (!world.tree().contains(link_)) return release();
  const Pose pose = world.pose(link_);
  const Vector3 arm = pose.orientation * point_;
  const Twist twist = world.velocity(link_);
  const Vector3 velocity = twist.linear + twist.angular.cross(arm);
  const double damping = std::min(2 * kFrequency * mass_, kMostDamping * link_mass_ / duration);
  Vector3 force = (target_ - pose.position - arm) * (kFrequency * kFrequency * mass_) - velocity * damping;
  const double most = kMostForce * mass_;
  if (force.norm() > most) force *= most / force.norm();
  world.wrenches().apply(link_, {force, {}}, pose.position + arm);
}

void PointSpring::reset(World& /*world*/) { release(); }

void PointSpring::transfer(StateArchive& archive) { archive(link_, point_, target_, mass_, link_mass_); }

}  // namespace bubblesim
