// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/trajectory_controller.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"

namespace bubblesim::control {
namespace {

bool within_limit(double error, double limit) { return !(limit > 0) || std::abs(error) <= limit; }

bool within_tolerance(const JointState& error, const JointTolerance& tolerance) {
  return within_limit(error.position, tolerance.position) && within_limit(error.velocity, tolerance.velocity) &&
         within_limit(error.acceleration, tolerance.acceleration);
}

JointKnot knot_of(const JointState& state, double time) {
  return {time, state.position, state.velocity, state.acceleration};
}

void check_knots(const TrajectoryController::Knots& knots, std::size_t joints) {
  if (knots.size() != joints) throw InvalidInput("a trajectory must have points for each joint");
  for (const std::vector<JointKnot>& of_joint : knots) {
    const auto not_later = [](const JointKnot& a, const JointKnot& b) { return !(a.time < b.time); };
    if (std::adjacent_find(of_joint.begin(), of_joint.end(), not_later) != of_joint.end()) {
      throw InvalidInput("the times of a trajectory's points must increase");
    }
    for (const JointKnot& knot : of_joint) {
      const bool finite = std::isfinite(knot.time) && std::isfinite(knot.position) &&
                          std::isfinite(knot.velocity.value_or(0)) && std::isfinite(knot.acceleration.value_or(0));
      if (!finite) throw InvalidInput("the numbers of a trajectory's points must be finite");
    }
  }
}

}  // namespace

TrajectoryController::TrajectoryController(Settings settings)
    : settings_(std::move(settings)),
      segments_(settings_.joints.size()),
      desired_(settings_.joints.size()),
      actual_(settings_.joints.size()),
      error_(settings_.joints.size()) {
  if (!settings_.gains.empty() && settings_.gains.size() != settings_.joints.size()) {
    throw InvalidInput("a trajectory controller needs the gains of each joint, or none");
  }
  settings_.velocity_feed.resize(settings_.joints.size());
  settings_.wraps.resize(settings_.joints.size());
  for (const PidGains& gains : settings_.gains) pids_.emplace_back(gains);
}

void TrajectoryController::follow(const Knots& knots, double start, double now,
                                  const std::optional<GoalTolerances>& goal) {
  check_knots(knots, settings_.joints.size());
  const double splice = std::max(start, now);
  std::vector<Segments> next;
  double end = now;
  for (std::size_t joint = 0; joint < knots.size(); ++joint) {
    Segments segments;
    for (const JointSegment& segment : segments_[joint]) {  // what is left before the new trajectory
      if (segment.end() > now && segment.start() < splice) segments.push_back(segment);
    }
    JointKnot last = knot_of(state_of(segments_[joint], splice), splice);
    if (segments.empty()) segments.emplace_back(last, last);
    const double turns =
        settings_.wraps[joint] ? std::round((last.position - knots[joint].front().position) / kTurn) : 0;
    for (JointKnot knot : knots[joint]) {
      if (knot.time < now) continue;
      knot.position += turns * kTurn;
      segments.emplace_back(last, knot);
      last = knot;
    }
    if (last.time < now || knots[joint].back().time < now) throw InvalidInput("all points of the trajectory are over");
    end = std::max(end, last.time);
    next.push_back(std::move(segments));
  }
  segments_ = std::move(next);
  goal_ = goal;
  goal_end_ = end;
  status_ = goal ? GoalStatus::kActive : GoalStatus::kNone;
}

void TrajectoryController::hold(double now) {
  for (std::size_t joint = 0; joint < segments_.size(); ++joint) {
    const JointState from = settings_.stop_duration > 0 ? state_of(segments_[joint], now) : actual_[joint];
    JointKnot start = knot_of(from, now);
    // Half the way that the velocity alone would take, which a constant deceleration takes.
    const double rest = start.position + from.velocity * settings_.stop_duration / 2;
    segments_[joint] = {JointSegment(start, {now + settings_.stop_duration, rest, 0.0, 0.0})};
    if (settings_.stop_duration <= 0) segments_[joint] = {JointSegment({now, start.position}, {now, start.position})};
  }
  goal_.reset();
  status_ = GoalStatus::kNone;
}

/// Of the last segment that has begun, so that new points may overlap the end of what was before.
JointState TrajectoryController::state_of(const Segments& segments, double time) {
  const auto later = std::upper_bound(segments.begin(), segments.end(), time,
                                      [](double t, const JointSegment& segment) { return t < segment.start(); });
  return later == segments.begin() ? segments.front().at(time) : std::prev(later)->at(time);
}

std::vector<JointState> TrajectoryController::at(double time) const {
  std::vector<JointState> states;
  for (const Segments& segments : segments_) {
    states.push_back(segments.empty() ? JointState{} : state_of(segments, time));
  }
  return states;
}

void TrajectoryController::starting(RobotHardware& robot, double time) {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const ControlledJoint& joint = robot.joints()[settings_.joints[i]];
    const JointKnot here{time, joint.position};
    segments_[i] = {JointSegment(here, here)};
    actual_[i] = {joint.position, joint.velocity, 0};
  }
  for (Pid& pid : pids_) pid.reset();
  goal_.reset();
  status_ = GoalStatus::kNone;
}

void TrajectoryController::update(RobotHardware& robot, double time, double period) {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    ControlledJoint& joint = robot.joints()[settings_.joints[i]];
    desired_[i] = state_of(segments_[i], time);
    actual_[i] = {joint.position, joint.velocity, 0};
    error_[i] = {position_error(joint, desired_[i].position, joint.position), desired_[i].velocity - joint.velocity, 0};
    if (!pids_.empty()) {
      const double feed = settings_.velocity_feed[i] * desired_[i].velocity;
      joint.command = feed + pids_[i].command(error_[i].position, error_[i].velocity, period);
    } else if (joint.interface == CommandInterface::kPosition) {
      joint.command = state_of(segments_[i], time + period).position;  // where it should be when the motor has moved it
    } else {
      joint.command = desired_[i].velocity;
    }
  }
  if (status_ == GoalStatus::kActive) check_goal(time);
}

void TrajectoryController::check_goal(double time) {
  const bool is_moving = time < goal_end_;
  const std::vector<JointTolerance>& tolerances = is_moving ? goal_->path : goal_->goal;
  for (std::size_t i = 0; i < error_.size(); ++i) {
    if (within_tolerance(error_[i], tolerances.at(i))) continue;
    violating_ = i;
    if (is_moving) {
      status_ = GoalStatus::kPathViolated;
    } else if (time >= goal_end_ + goal_->goal_time) {
      status_ = GoalStatus::kGoalMissed;
    }
    return;
  }
  if (!is_moving) status_ = GoalStatus::kReached;
}

void TrajectoryController::transfer(StateArchive& archive) {
  archive(segments_, status_, goal_end_, violating_);
  for (Pid& pid : pids_) archive(pid);
  bool watched = goal_.has_value();
  archive(watched);
  if (archive.restores()) goal_ = watched ? std::make_optional(GoalTolerances{}) : std::nullopt;
  if (!goal_) return;
  archive(goal_->goal_time);
  for (std::vector<JointTolerance>* tolerances : {&goal_->path, &goal_->goal}) {
    tolerances->resize(archive.count(tolerances->size()));
    for (JointTolerance& each : *tolerances) archive(each.position, each.velocity, each.acceleration);
  }
}

}  // namespace bubblesim::control
