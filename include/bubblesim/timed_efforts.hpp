// SPDX-License-Identifier: BSD-3-Clause
// Wrenches on links and efforts on joints that act during an interval of simulation time, as Gazebo's services apply
// them.
#pragma once

#include <optional>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Add it to a world without a rate: it then acts with the resolution of the substeps. In a substep that an interval
/// covers in part, it applies the mean, so that the impulse is exact.
class TimedEfforts final : public Device {
 public:
  /// The interval starts at `start`, in s of simulation time, and lasts `duration` s; negative: until it is cleared.
  struct Interval {
    double start = 0;
    double duration = 0;
  };

  /// A wrench in world axes, at a point of the link in the link's frame, by default its centre of mass. Throws like
  /// World::apply_wrench, and InvalidInput when the interval is not finite.
  void add_wrench(const World& world, ObjectId link, const Wrench& wrench, const std::optional<Vector3>& point,
                  const Interval& interval);
  /// A force or torque about a joint's first axis on the child and its opposite on the parent, in addition to the
  /// joint's motor; at most the motor's force limit. Throws WrongObject for joints without an axis.
  void add_effort(const World& world, ObjectId joint, double effort, const Interval& interval);
  void clear_wrenches(ObjectId link);
  void clear_efforts(ObjectId joint);

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  struct TimedWrench {
    ObjectId link;
    Wrench wrench;
    std::optional<Vector3> point;
    Interval interval;
    void transfer(StateArchive& archive);
  };
  struct TimedEffort {
    ObjectId joint;
    double effort;
    Interval interval;
    void transfer(StateArchive& archive);
  };

  std::vector<TimedWrench> wrenches_;
  std::vector<TimedEffort> efforts_;
};

}  // namespace bubblesim
