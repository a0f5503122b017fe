// SPDX-License-Identifier: BSD-3-Clause
// Gives a model or a link a velocity along its own axes.
#pragma once

#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Sets the velocity before each substep, as gz-sim's VelocityControl does: forces, friction and gravity act within a
/// substep only. The parts of a model keep their motion relative to each other, so wheels turn on. Without a command it
/// does not touch the object. Add it to a world without a rate.
class SpatialDrive final : public Device {
 public:
  /// A moving model or link. Throws WrongObject for other objects.
  SpatialDrive(const World& world, ObjectId object);

  /// m/s and rad/s along the object's axes. Throws InvalidInput unless they are finite and at most 1e6.
  void set_velocity(const Twist& velocity);

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  ObjectId object_;
  std::vector<ObjectId> links_;
  Vector3 linear_;
  Vector3 angular_;
  bool commanded_ = false;
};

}  // namespace bubblesim
