// SPDX-License-Identifier: BSD-3-Clause
// The drive of a robot that forces push through the plane in any direction.
#pragma once

#include <cstdint>
#include <optional>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Pushes a link by forces that are proportional to the error of its velocity, along its own horizontal axes. Without a
/// command it brakes. The motion is that of the forces of each moment, whatever the physics substep is: a robot without
/// friction approaches the velocity exponentially, one with friction keeps an error of friction / gain.
class PlanarForceDrive final : public Device {
 public:
  struct Gains {
    double forward = 0;   ///< N s/m
    double leftward = 0;  ///< N s/m
    double turning = 0;   ///< N m s, about the vertical
  };

  /// Throws InvalidInput unless the gains are finite and not negative; NoSuchObject; WrongObject unless it is a link
  /// that can move.
  PlanarForceDrive(const World& world, ObjectId link, const Gains& gains);

  /// m/s along the link's x and y, rad/s about the world's z. Throws InvalidInput unless they are finite and at most
  /// 1e6.
  void set_velocity(double forward, double leftward, double turning);

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  /// What the last update did, to know what else pushed since then.
  struct Push {
    double duration = 0;  // s; 0: none
    Twist twist;          // before it
    Wrench wrench;
  };

  void weigh(const World& world);
  /// The acceleration by everything else in the last substep, linear and about the vertical.
  Twist other_acceleration(const Twist& now) const;

  ObjectId link_;
  Gains gains_;
  double forward_ = 0;
  double leftward_ = 0;
  double turning_ = 0;
  Push last_;
  std::optional<std::uint64_t> revision_;  // of the world in which the model was weighed
  double mass_ = 0;                        // kg, of the model
  double inertia_ = 0;                     // kg m², of the model about the vertical through the link's centre of mass
};

}  // namespace bubblesim
