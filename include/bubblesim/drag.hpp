// SPDX-License-Identifier: BSD-3-Clause
// Linear and quadratic drag of a link in air or water.
#pragma once

#include <memory>

#include "bubblesim/device.hpp"
#include "bubblesim/wind.hpp"

namespace bubblesim {

/// Coefficients along and about the axes of the link's frame.
struct DragDescription {
  ObjectId link = kNoObject;
  Vector3 linear;             ///< N s/m: force = -linear * v - quadratic * |v| * v, for each axis
  Vector3 quadratic;          ///< N s^2/m^2
  Vector3 angular_linear;     ///< N m s: torque = -angular_linear * w - angular_quadratic * |w| * w, for each axis
  Vector3 angular_quadratic;  ///< N m s^2
  bool in_wind = false;       ///< the fluid moves with the wind in addition to the current
};

/// Pushes a link at its origin against the velocity of this point relative to the fluid, and turns it against its
/// angular velocity. This is the diagonal damping of Fossen, Guidance and control of ocean vehicles, 1994, chapter 2.4;
/// for air, quadratic = density/2 * drag coefficient * area. A coefficient that would reverse the motion of the link
/// alone within a substep stops it instead: the force is at most mass * v / duration.
class Drag final : public Device {
 public:
  /// Throws InvalidInput unless the coefficients are from 0 to 1e9, WrongObject when it is not a moving link. `wind`
  /// may be null when in_wind is false.
  Drag(const World& world, const DragDescription& description, std::shared_ptr<const Wind> wind);

  /// m/s, world axes; of the fluid. Until the next reset. Throws InvalidInput unless it is finite and at most 1e6.
  void set_current(const Vector3& current);

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  DragDescription description_;
  std::shared_ptr<const Wind> wind_;
  Vector3 current_;
};

}  // namespace bubblesim
