// SPDX-License-Identifier: BSD-3-Clause
// Wheels whose tyres slip in proportion to the friction that they transmit.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Slip ratio divided by the ratio of friction and normal force, without units: 0 does not slip.
struct SlipCompliance {
  double lateral = 0;       ///< along the wheel's axis
  double longitudinal = 0;  ///< across it
};

struct SlippingWheel {
  ObjectId joint = kNoObject;  ///< revolute or continuous; its child is the wheel
  double radius = 0;           ///< m
  double normal_force = 0;     ///< N, about that on the wheel at rest
  SlipCompliance compliance{};
};

/// Sets the slip of the wheels' collisions before each substep, as gz-sim's WheelSlip does: with the speed u = radius *
/// |joint velocity|, a friction force F lets the wheel slip at compliance * u * F / normal_force. At rest it does not
/// slip. The denominator u is that of the slip ratio in acceleration (Yoshida and Hamano, ICRA 2002). Friction remains
/// limited by the surface's coefficients. Add it to a world without a rate.
class WheelSlip final : public Device {
 public:
  /// Throws NoSuchObject; WrongObject unless the joints turn about one axis and their children have collisions;
  /// InvalidInput unless radii and forces are positive and compliances not negative, all finite.
  WheelSlip(const World& world, std::vector<SlippingWheel> wheels);

  /// Of all wheels, until the world is reset; what is not given stays. Throws InvalidInput as above.
  void set_compliance(std::optional<double> lateral, std::optional<double> longitudinal);
  /// Throws std::out_of_range.
  const SlipCompliance& compliance(std::size_t wheel) const { return present_.at(wheel); }
  /// m/s: the velocity of the wheel's link ahead, less that of its circumference; its velocity along the axis; that of
  /// its circumference. Ahead is across the axis and the present gravity. Throws std::out_of_range.
  Vector3 slip(const World& world, std::size_t wheel) const;

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  std::vector<SlippingWheel> wheels_;
  std::vector<SlipCompliance> present_;
  std::vector<Vector3> axes_;  // of the wheels, in their links
};

}  // namespace bubblesim
