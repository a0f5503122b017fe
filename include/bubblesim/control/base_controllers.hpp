// SPDX-License-Identifier: BSD-3-Clause
// Controllers of mobile bases: velocities of the robot to those of its wheels, and odometry.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bubblesim/control/controller_manager.hpp"
#include "bubblesim/control/speed_limiter.hpp"
#include "bubblesim/control/wheel_odometry.hpp"

namespace bubblesim::control {

/// What controllers of bases have in common: a command with a timeout, limits, odometry.
class BaseController : public Controller {
 public:
  struct Settings {
    double timeout = 0.5;               ///< s without a command after which the robot stops; 0: none
    bool open_loop = false;             ///< odometry from the commands instead of the wheels
    std::size_t window = 10;            ///< of the odometry's velocities
    std::array<SpeedLimits, 3> limits;  ///< of the numbers of a command
  };

  /// Of a robot that turns by its wheels' velocities: m/s forward, m/s to the left, rad/s. Of a steered robot: see its
  /// class.
  using Command = std::array<double, 3>;

  explicit BaseController(const Settings& settings) : settings_(settings), odometry_(settings.window) {}

  /// Takes a command, which holds from the next update on. Returns false for numbers that are not usable.
  bool set_command(const Command& command);
  const WheelOdometry& odometry() const { return odometry_; }
  /// What the last update has made of the command.
  const Command& limited_command() const { return last_; }

  void starting(RobotHardware& robot, double time) final;
  void update(RobotHardware& robot, double time, double period) final;
  void transfer(StateArchive& archive) final;

 protected:
  /// How the robot has moved since the last call, by its wheels.
  virtual PlanarMotion moved(const RobotHardware& robot) = 0;
  /// How a command moves it in `period` s.
  virtual PlanarMotion commanded(const Command& command, double period) const;
  virtual void command_wheels(RobotHardware& robot, const Command& command) = 0;
  virtual void begin(const RobotHardware& robot) = 0;
  virtual void transfer_wheels(StateArchive& archive) = 0;

 private:
  Settings settings_;
  WheelOdometry odometry_;
  Command command_{};
  Command last_{};
  Command second_last_{};
  bool is_new_ = false;  // the command came after the last update
  double received_ = 0;  // s
};

/// diff_drive_controller/DiffDriveController.
class DiffDriveController final : public BaseController {
 public:
  struct Wheels {
    std::vector<std::size_t> left;  ///< indices into RobotHardware::joints()
    std::vector<std::size_t> right;
    double separation = 0;    ///< m, with its multiplier
    double left_radius = 0;   ///< m, with its multiplier
    double right_radius = 0;  ///< m
  };

  /// Throws InvalidInput for as many wheels on one side as on the other, and for lengths that are not above 0.
  DiffDriveController(Wheels wheels, const Settings& settings);
  std::vector<std::size_t> claimed() const override;

 private:
  PlanarMotion moved(const RobotHardware& robot) override;
  void command_wheels(RobotHardware& robot, const Command& command) override;
  void begin(const RobotHardware& robot) override;
  void transfer_wheels(StateArchive& archive) override;

  Wheels wheels_;
  double left_ = 0;  // m, that the rims have turned
  double right_ = 0;
};

/// ackermann_steering_controller/AckermannSteeringController: one driven joint, one steered joint.
/// Its command is m/s forward, a number without effect, and the angle of the front wheels in rad.
class AckermannSteeringController final : public BaseController {
 public:
  struct Wheels {
    std::size_t rear = 0;   ///< its velocity is commanded
    std::size_t steer = 0;  ///< its position is commanded
    double wheel_base = 0;  ///< m
    double radius = 0;      ///< m, of the rear wheel
  };

  /// Throws InvalidInput for lengths that are not above 0.
  AckermannSteeringController(const Wheels& wheels, const Settings& settings);
  std::vector<std::size_t> claimed() const override { return {wheels_.rear, wheels_.steer}; }

 private:
  PlanarMotion moved(const RobotHardware& robot) override;
  PlanarMotion commanded(const Command& command, double period) const override;
  void command_wheels(RobotHardware& robot, const Command& command) override;
  void begin(const RobotHardware& robot) override;
  void transfer_wheels(StateArchive& archive) override;

  Wheels wheels_;
  double rear_ = 0;  // m
};

/// Throws InvalidInput unless a length in m is finite and above 0.
void require_length(const char* what, double length);

}  // namespace bubblesim::control
