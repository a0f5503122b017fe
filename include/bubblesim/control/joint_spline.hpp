// SPDX-License-Identifier: BSD-3-Clause
// The motion of a joint between two points of a trajectory: a polynomial of degree 1, 3 or 5.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bubblesim/state_archive.hpp"

namespace bubblesim::control {

/// Position in rad or m, and its derivatives by s.
struct JointState {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

/// A point of a trajectory. Without accelerations at both ends of a segment it is cubic, without velocities linear.
struct JointKnot {
  double time = 0;  ///< s
  double position = 0;
  std::optional<double> velocity{};
  std::optional<double> acceleration{};
};

/// The polynomial through two knots: it has their positions, and those derivatives that both have.
class JointSegment {
 public:
  JointSegment() = default;
  /// `end.time` must not be before `start.time`.
  JointSegment(const JointKnot& start, const JointKnot& end);

  double start() const { return start_; }
  double end() const { return start_ + duration_; }
  /// The state at a time; at rest at the ends before the start and after the end.
  JointState at(double time) const;
  void transfer(StateArchive& archive);

 private:
  double start_ = 0;
  double duration_ = 0;
  std::array<double, 6> coefficients_{};
};

}  // namespace bubblesim::control
