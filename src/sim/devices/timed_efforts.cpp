// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/timed_efforts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "bubblesim/error.hpp"
#include "scene/describe.hpp"
#include "scene/joint_kind.hpp"
#include "validation/limits.hpp"

namespace bubblesim {
namespace {

void check_interval(const TimedEfforts::Interval& interval) {
  if (std::isfinite(interval.start) && std::isfinite(interval.duration)) return;
  throw InvalidInput("the interval of " + text(interval.duration) + " s from " + text(interval.start) +
                     " s on is not usable: both numbers must be finite");
}

double end_of(const TimedEfforts::Interval& interval) {
  return interval.duration < 0 ? std::numeric_limits<double>::infinity() : interval.start + interval.duration;
}

/// The part of the time from `time` on that an interval covers.
double covered(const TimedEfforts::Interval& interval, double time, double duration) {
  const double overlap = std::min(end_of(interval), time + duration) - std::max(interval.start, time);
  return std::clamp(overlap / duration, 0.0, 1.0);
}

template <class Timed>
void forget_ended(std::vector<Timed>& all, double time) {
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Timed& one) { return end_of(one.interval) <= time; }),
            all.end());
}

/// Pushes the child of a joint along its first axis, and the parent in the opposite direction, for a part of the time.
void push_joint(World& world, ObjectId joint, double effort, double part) {
  const JointDescription& description = world.joints().description(joint);
  const double limit = world.joints().max_force(joint);
  const Pose frame = world.joints().axes(joint) == 1 ? world.joints().child_pose(joint) : world.pose(joint);
  const Vector3 axis = frame.orientation * description.axes.front().direction;
  const Vector3 push = axis * (std::clamp(effort, -limit, limit) * part);
  const Wrench wrench = find_joint_kind(description.type)->slides ? Wrench{push, {}} : Wrench{{}, push};
  const auto [parent, child] = world.joints().links(joint);
  world.wrenches().apply(child, wrench, frame.position);
  if (parent != kNoObject) world.wrenches().apply(parent, {-wrench.force, -wrench.torque}, frame.position);
}

}  // namespace

void TimedEfforts::add_wrench(const World& world, ObjectId link, const Wrench& wrench,
                              const std::optional<Vector3>& point, const Interval& interval) {
  world.wrenches().check(link, wrench, point);
  check_interval(interval);
  wrenches_.push_back({link, wrench, point, interval});
}

void TimedEfforts::add_effort(const World& world, ObjectId joint, double effort, const Interval& interval) {
  world.joints().max_force(joint);  // throws when it has no axis
  if (!within(effort, kMaxEffort)) {
    throw InvalidInput(world.tree().short_path(joint) + ": the effort " + text(effort) +
                       " is not usable: it must be finite and at most 1e9");
  }
  check_interval(interval);
  efforts_.push_back({joint, effort, interval});
}

void TimedEfforts::clear_wrenches(ObjectId link) {
  const auto is_it = [&](const TimedWrench& one) { return one.link == link; };
  wrenches_.erase(std::remove_if(wrenches_.begin(), wrenches_.end(), is_it), wrenches_.end());
}

void TimedEfforts::clear_efforts(ObjectId joint) {
  const auto is_it = [&](const TimedEffort& one) { return one.joint == joint; };
  efforts_.erase(std::remove_if(efforts_.begin(), efforts_.end(), is_it), efforts_.end());
}

void TimedEfforts::update(World& world, double time, double duration) {
  forget_ended(wrenches_, time);
  forget_ended(efforts_, time);
  // The models may have been removed meanwhile.
  const SceneTree& tree = world.tree();
  for (const TimedWrench& one : wrenches_) {
    const double part = covered(one.interval, time, duration);
    if (part == 0 || !tree.contains(one.link)) continue;
    const Wrench mean{one.wrench.force * part, one.wrench.torque * part};
    const auto at = [&](const Vector3& point) { return world.pose(one.link) * point; };
    world.wrenches().apply(one.link, mean, one.point ? std::make_optional(at(*one.point)) : std::nullopt);
  }
  for (const TimedEffort& one : efforts_) {
    const double part = covered(one.interval, time, duration);
    if (part != 0 && tree.contains(one.joint)) push_joint(world, one.joint, one.effort, part);
  }
}

void TimedEfforts::reset(World&) {
  wrenches_.clear();
  efforts_.clear();
}

void TimedEfforts::TimedWrench::transfer(StateArchive& archive) {
  archive(link, wrench, point, interval.start, interval.duration);
}

void TimedEfforts::TimedEffort::transfer(StateArchive& archive) {
  archive(joint, effort, interval.start, interval.duration);
}

void TimedEfforts::transfer(StateArchive& archive) { archive(wrenches_, efforts_); }

}  // namespace bubblesim
