// SPDX-License-Identifier: BSD-3-Clause
// Lift and drag of a wing.
#pragma once

#include <memory>
#include <vector>

#include "bubblesim/device.hpp"
#include "bubblesim/wind.hpp"

namespace bubblesim {

/// The parameters of Gazebo's LiftDrag plugin, with its defaults. Vectors are in the link's frame.
struct LiftDragDescription {
  ObjectId link = kNoObject;
  double area = 1;                          ///< m^2
  double density = 1.2041;                  ///< kg/m^3, of the air
  Vector3 centre_of_pressure;               ///< m
  Vector3 forward = Vector3::UnitX();       ///< of the chord
  Vector3 upward = Vector3::UnitZ();        ///< of the lift
  bool radial_symmetry = false;             ///< about forward: upward follows the flow
  double alpha0 = 0;                        ///< rad, angle of attack when the air flows along forward
  double lift_slope = 1;                    ///< 1/rad: lift coefficient / angle of attack
  double drag_slope = 0.01;                 ///< 1/rad: drag coefficient / angle of attack
  double alpha_stall = 1.5707963267948966;  ///< rad, angle of attack of the stall
  double lift_slope_stall = 0;              ///< 1/rad, beyond the stall
  double drag_slope_stall = 1;              ///< 1/rad, beyond the stall
  ObjectId control_joint = kNoObject;       ///< of a flap, or none
  double control_slope = 4;                 ///< change of the lift coefficient by the position of that joint, 1/rad
};

/// Pushes a link at the centre of pressure with the lift C_L q A across the flow, and with the drag C_D q A along it;
/// q = density/2 v^2, v being the velocity relative to the wind without its part along the span. The coefficients are
/// proportional to the angle of attack up to the stall, and change with the other slopes beyond; a lift coefficient
/// does not change its sign beyond. Both are multiplied by the squared cosine of the sweep, the angle between the flow
/// and the plane of forward and upward. Formulas of Gazebo's LiftDrag.
class LiftDrag final : public Device {
 public:
  /// Throws InvalidInput for parameters out of range, WrongObject for other objects. `wind` may be null.
  LiftDrag(const World& world, const LiftDragDescription& description, std::shared_ptr<const Wind> wind);

  void update(World& world, double time, double duration) override;

 private:
  LiftDragDescription description_;
  std::shared_ptr<const Wind> wind_;
};

}  // namespace bubblesim
