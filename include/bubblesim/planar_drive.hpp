// SPDX-License-Identifier: BSD-3-Clause
// The drive of a robot that moves in the plane in any direction.
#pragma once

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Moves a model at a velocity along its own axes: a constant velocity gives a circle. Without a command it does not
/// touch the model.
class PlanarDrive final : public Device {
 public:
  /// An outermost model.
  explicit PlanarDrive(ObjectId model) : model_(model) {}

  /// m/s along the model's x and y, rad/s about the world's z. Throws InvalidInput unless they are finite and at most
  /// 1e6.
  void set_velocity(double forward, double leftward, double turning);

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  ObjectId model_;
  double forward_ = 0;
  double leftward_ = 0;
  double turning_ = 0;
  bool commanded_ = false;
};

}  // namespace bubblesim
