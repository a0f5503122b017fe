// SPDX-License-Identifier: BSD-3-Clause
// Flies a multicopter at a commanded velocity.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "bubblesim/device.hpp"
#include "bubblesim/rotor.hpp"

namespace bubblesim {

/// Gains along and about the axes of the link, with the units of gz-sim's MulticopterVelocityControl.
struct VelocityControlDescription {
  ObjectId link = kNoObject;  ///< the airframe, at the centre of mass of the model
  Vector3 velocity_gain;      ///< N s/m
  Vector3 attitude_gain;      ///< N m/rad
  Vector3 rate_gain;          ///< N m s/rad
  Vector3 max_acceleration = Vector3::Constant(std::numeric_limits<double>::max());  ///< m/s^2, along the world's axes
};

/// Commands the speeds of rotors so that the airframe has a velocity along its own axes and a yaw rate: the force is
/// velocity gain * velocity error and the weight, the torque -attitude gain * e_R - rate gain * e_omega. From Lee,
/// Leok, McClamroch: Geometric tracking control of a quadrotor UAV on SE(3), CDC 2010, as in gz-sim. Without a command
/// it does not touch the rotors.
class MulticopterVelocityControl final : public Device {
 public:
  /// Throws InvalidInput when gains are negative or not finite, or when the rotors cannot exert torques about all axes;
  /// WrongObject when the link cannot be moved.
  MulticopterVelocityControl(const World& world, const VelocityControlDescription& description,
                             std::vector<std::shared_ptr<Rotor>> rotors);

  /// m/s along the axes of the link, and rad/s about its z. Throws InvalidInput unless finite and at most 1e6.
  void set_velocity(const Vector3& linear, double yaw_rate);
  /// Stops the rotors, until the next command.
  void stop();

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  struct Command {
    Vector3 linear;
    double yaw_rate;
  };

  VelocityControlDescription description_;
  std::vector<std::shared_ptr<Rotor>> rotors_;
  std::vector<double> mixing_;  // squared speeds of the rotors by torque x, y, z and thrust, row by row
  double mass_ = 0;             // kg, of the model
  std::optional<Command> command_;
};

}  // namespace bubblesim
