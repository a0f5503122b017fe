// SPDX-License-Identifier: BSD-3-Clause
// joint_trajectory_controller/JointTrajectoryController: joints follow splines through points.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bubblesim/control/controller_manager.hpp"
#include "bubblesim/control/joint_spline.hpp"

namespace bubblesim::control {

/// Largest errors; 0: no limit. rad or m, and their derivatives by s.
struct JointTolerance {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

struct GoalTolerances {
  std::vector<JointTolerance> path;  ///< of each joint, while it moves
  std::vector<JointTolerance> goal;  ///< at the end
  double goal_time = 0;              ///< s after the end in which the goal may be reached
};

enum class GoalStatus : std::uint8_t { kNone, kActive, kReached, kPathViolated, kGoalMissed };

class TrajectoryController final : public Controller {
 public:
  struct Settings {
    std::vector<std::size_t> joints;    ///< indices into RobotHardware::joints()
    std::vector<PidGains> gains;        ///< of each joint; empty: the positions or velocities are commanded
    std::vector<double> velocity_feed;  ///< factor of the desired velocity in the command, of each joint
    std::vector<bool> wraps;            ///< whether the joint turns without limits: full turns of points do not matter
    double stop_duration = 0;           ///< s
  };
  /// Points of each joint, in the order of the joints; each has one at least.
  using Knots = std::vector<std::vector<JointKnot>>;

  explicit TrajectoryController(Settings settings);

  /// Follows new points from `start` on, s of simulation time; before it the present trajectory goes on. Points that
  /// are over are dropped. `goal`: its end and its tolerances are watched; it replaces a goal that is active. Throws
  /// InvalidInput when nothing is left, and for times that do not increase.
  void follow(const Knots& knots, double start, double now, const std::optional<GoalTolerances>& goal);
  /// Ends the goal and the trajectory: within Settings::stop_duration the joints come to rest.
  void hold(double now);
  GoalStatus goal_status() const { return status_; }
  /// Which joint has violated a tolerance: an index into Settings::joints.
  std::size_t violating_joint() const { return violating_; }
  /// Of the last update, for each joint.
  const std::vector<JointState>& desired() const { return desired_; }
  const std::vector<JointState>& actual() const { return actual_; }
  const std::vector<JointState>& error() const { return error_; }
  /// The desired states at a time.
  std::vector<JointState> at(double time) const;

  void starting(RobotHardware& robot, double time) override;
  void update(RobotHardware& robot, double time, double period) override;
  void transfer(StateArchive& archive) override;
  std::vector<std::size_t> claimed() const override { return settings_.joints; }

 private:
  using Segments = std::vector<JointSegment>;

  static JointState state_of(const Segments& segments, double time);
  void check_goal(double time);

  Settings settings_;
  std::vector<Pid> pids_;
  std::vector<Segments> segments_;  // of each joint, never empty while it runs
  std::vector<JointState> desired_;
  std::vector<JointState> actual_;
  std::vector<JointState> error_;
  std::optional<GoalTolerances> goal_;
  double goal_end_ = 0;  // s
  GoalStatus status_ = GoalStatus::kNone;
  std::size_t violating_ = 0;
};

}  // namespace bubblesim::control
