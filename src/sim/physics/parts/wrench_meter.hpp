// SPDX-License-Identifier: BSD-3-Clause
// The wrench that a joint transmits, substep by substep, from the feedback of its joints in ODE or from a solver.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/state_archive.hpp"
#include "bubblesim/wrench.hpp"
#include "physics/parts/link.hpp"
#include "physics/parts/substep_signal.hpp"

namespace bubblesim {

/// ODE's joints keep pointers to its reports.
class WrenchMeter {
 public:
  /// Requests the feedback of the joints between two links; `parent` is null for the world. `joint_in_child` is the
  /// pose of the joint in the child link's frame.
  WrenchMeter(const Link* parent, const Link& child, const Pose& joint_in_child);
  WrenchMeter(const WrenchMeter&) = delete;
  WrenchMeter& operator=(const WrenchMeter&) = delete;

  /// `sensor` is the Object::index of a force-torque sensor, `in_joint` its pose in the joint's frame.
  void add_sensor(const ForceTorqueDescription& description, std::size_t sensor, const Pose& in_joint);

  /// Call when the joint has got another pose in the child link's frame.
  void place(const Pose& joint_in_child) { joint_in_child_ = joint_in_child; }

  void clear();
  /// Call before and after each substep: ODE's forces refer to the positions at its start.
  void begin();
  void end(double step);
  /// Call in between if another solver finds what the parent exerts on the child: N s and N m s about a point, on the
  /// way from the positions at the start to the present ones.
  void report(const Wrench& impulse, const Vector3& point);

  /// Of the child on the parent since clear(), in world axes, about the joint's origin: N s and N m s.
  const Wrench& impulse() const { return impulse_; }
  /// In the axes of the sensor's description: mean since clear(), or filtered. Nothing for other sensors.
  std::optional<Wrench> of_sensor(std::size_t sensor) const;

  void transfer(StateArchive& archive);

 private:
  struct Report {
    dJointID joint = nullptr;
    dJointFeedback feedback{};
  };
  struct Signal {
    explicit Signal(const ForceTorqueDescription& description_)
        : description(description_), force(description.bandwidth), torque(description.bandwidth) {}

    const ForceTorqueDescription& description;
    std::size_t sensor = 0;
    Pose in_joint;
    SubstepSignal force;   // N
    SubstepSignal torque;  // N m, about the sensor's origin
  };

  Wrench from_feedback() const;
  Wrench from_solver(double step);
  Quaternion axes_of(ForceTorqueDescription::Frame frame, const Quaternion& sensor) const;

  const Link* parent_;
  const Link& child_;
  Pose joint_in_child_;
  std::deque<Report> reports_;
  std::vector<Signal> signals_;
  Wrench impulse_;
  std::optional<Wrench> reported_;  // N s and N m s, about the next
  Vector3 reported_about_;
  // At the start of the substep, or on the way:
  Pose child_pose_;
  Quaternion parent_axes_;
  Vector3 child_centre_;  // of mass, in the world
};

}  // namespace bubblesim
