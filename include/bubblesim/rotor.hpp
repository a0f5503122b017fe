// SPDX-License-Identifier: BSD-3-Clause
// A propeller of a multicopter.
#pragma once

#include <memory>

#include "bubblesim/device.hpp"
#include "bubblesim/wind.hpp"

namespace bubblesim {

/// The parameters of Gazebo's multicopter motor model, with its defaults.
struct RotorDescription {
  ObjectId joint = kNoObject;  ///< revolute or continuous; its child is the propeller, its parent the airframe
  bool clockwise = false;      ///< turns clockwise seen from where the thrust points
  double thrust_coefficient = 8.54858e-6;  ///< N s^2: thrust = coefficient * speed^2
  double torque_length = 0.016;            ///< m: reaction torque = length * thrust
  double drag_coefficient = 1e-4;          ///< kg: drag = coefficient * speed * velocity across the axis
  double rolling_coefficient = 1e-6;       ///< kg m: torque = coefficient * speed * velocity across the axis
  double max_speed = 838;                  ///< rad/s
  double time_up = 1.0 / 80;               ///< s, time constant of rising speed
  double time_down = 1.0 / 40;             ///< s, time constant of falling speed
  double slowdown = 10;                    ///< the joint turns this many times slower than the propeller
};

/// Turns the joint with a velocity motor and pushes its links:
///   - the propeller with the thrust k w |w| along the joint's axis, and with the drag -c_d |w| v across the axis;
///   - the airframe with the reaction torque -+ l k w |w| about the axis, and with the rolling moment -c_r |w| v.
/// w is the measured speed of the joint times the slowdown, v the velocity of the propeller's centre of mass relative
/// to the wind, across the axis. The commanded speed is approached exponentially. From Furrer et al., RotorS: a modular
/// Gazebo MAV simulator framework, 2016, and Martin, Salaun: The true role of accelerometer feedback in quadrotor
/// control, ICRA 2010.
class Rotor final : public Device {
 public:
  /// Throws InvalidInput for parameters out of range, and WrongObject for another joint. `wind` may be null.
  Rotor(World& world, const RotorDescription& description, std::shared_ptr<const Wind> wind);

  /// Commands the speed in rad/s, limited to max_speed; negative values reverse the thrust. Throws InvalidInput unless
  /// it is finite. A target velocity that is set for the joint, such as by a child script, is a command too: target *
  /// slowdown, positive as the joint's axis.
  void set_speed(double speed);
  /// The commanded speed after the first-order response, rad/s.
  double speed() const { return speed_; }
  const RotorDescription& description() const { return description_; }

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  void take_command_of_joint(const World& world);
  void push(World& world) const;

  RotorDescription description_;
  std::shared_ptr<const Wind> wind_;
  double wanted_ = 0;  // rad/s
  double speed_ = 0;   // rad/s
  double target_ = 0;  // rad/s, of the joint, that was set last
};

}  // namespace bubblesim
