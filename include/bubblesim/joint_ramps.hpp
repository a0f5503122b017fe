// SPDX-License-Identifier: BSD-3-Clause
// The motors of a drive: targets of joints that follow commands at limited rates.
#pragma once

#include <optional>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Has inputs, such as the speeds of a robot's wheels or its velocity, and outputs, which are the targets of joints. It
/// sets the outputs while inputs change; in between, others may command the joints.
class JointRamps final : public Device {
 public:
  /// The target of a joint's first axis: the sum of the inputs, each times its factor. It is a position in
  /// MotorMode::kPosition, and else a velocity. Velocities are limited to 1e6.
  struct Output {
    ObjectId joint = kNoObject;
    MotorMode mode = MotorMode::kVelocity;
    std::vector<double> factors;
  };

  /// `rates`: how fast each input may change, per s; infinite without a limit. Throws InvalidInput unless rates and
  /// factors are numbers, rates zero or more, and each output has a factor for each input.
  JointRamps(std::vector<double> rates, std::vector<Output> outputs);

  /// The inputs move towards these values from the next update on. Throws InvalidInput for another number of values,
  /// and for values that are not finite.
  void set_targets(std::vector<double> targets);
  /// Sets inputs and targets to zero, without commanding the joints.
  void stop();
  const std::vector<double>& inputs() const { return inputs_; }

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  std::vector<double> rates_;
  std::vector<Output> outputs_;
  std::vector<double> inputs_;
  std::vector<double> targets_;
  bool changing_ = false;
};

/// The inputs of a drive computed from commands, such as the velocities of a robot.
struct CommandMix {
  /// An input: the sum of the commands, each times its factor, divided by `divisor`.
  struct Row {
    std::vector<double> factors;
    double divisor = 1;
  };

  std::vector<Row> rows;
  double most = 1e6;  ///< of commands and inputs

  /// Inputs beyond `most` are scaled down together, so that the robot stays on the same curve. Empty for commands that
  /// are not usable: not finite, beyond `most`, or of another number than the factors.
  std::optional<std::vector<double>> inputs(const std::vector<double>& commands) const;
};

}  // namespace bubblesim
