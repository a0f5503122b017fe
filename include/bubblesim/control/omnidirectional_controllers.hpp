// SPDX-License-Identifier: BSD-3-Clause
// Controllers of bases that also move sideways: mecanum wheels, and four steered wheels.
#pragma once

#include <array>

#include "bubblesim/control/base_controllers.hpp"

namespace bubblesim::control {

/// mecanum_drive_controller/MecanumDriveController: four wheels whose rollers touch the ground along an X seen from
/// above. The speed of a wheel's rim is x -+ y -+ k w for the command (x, y, w), where k is half the sum of the
/// distances of the wheels along and across.
class MecanumDriveController final : public BaseController {
 public:
  struct Wheels {
    std::array<std::size_t, 4> joints{};  ///< front left, back left, back right, front right
    double k = 0;                         ///< m
    double radius = 0;                    ///< m
  };

  /// Throws InvalidInput for lengths that are not above 0.
  MecanumDriveController(const Wheels& wheels, const Settings& settings);
  std::vector<std::size_t> claimed() const override { return {wheels_.joints.begin(), wheels_.joints.end()}; }

 private:
  PlanarMotion moved(const RobotHardware& robot) override;
  void command_wheels(RobotHardware& robot, const Command& command) override;
  void begin(const RobotHardware& robot) override;
  void transfer_wheels(StateArchive& archive) override;

  Wheels wheels_;
  std::array<double, 4> rims_{};  // m, that the rims have turned
};

/// four_wheel_steering_controller/FourWheelSteeringController: four driven and steered wheels at the corners of a
/// rectangle, which move without slip about the robot's centre of rotation.
class FourWheelSteeringController final : public BaseController {
 public:
  struct Wheels {
    std::array<std::size_t, 4> driven{};   ///< front left, front right, rear left, rear right; velocities
    std::array<std::size_t, 4> steered{};  ///< positions, in the same order
    double track = 0;                      ///< m, from left to right
    double base = 0;                       ///< m, from the front to the rear axle
    double radius = 0;                     ///< m
    /// Commands are m/s forward and the angles of the middle of the front and of the rear axle in rad. Otherwise they
    /// are m/s forward, a number without effect, and rad/s.
    bool by_angles = false;
  };

  /// Throws InvalidInput for lengths that are not above 0.
  FourWheelSteeringController(const Wheels& wheels, const Settings& settings);
  std::vector<std::size_t> claimed() const override;

 private:
  PlanarMotion moved(const RobotHardware& robot) override;
  PlanarMotion commanded(const Command& command, double period) const override;
  void command_wheels(RobotHardware& robot, const Command& command) override;
  void begin(const RobotHardware& robot) override;
  void transfer_wheels(StateArchive& archive) override;
  std::array<double, 2> place(std::size_t wheel) const;  // m, x and y

  Wheels wheels_;
  std::array<double, 4> rims_{};  // m, that the rims have turned
};

}  // namespace bubblesim::control
