// SPDX-License-Identifier: BSD-3-Clause
// A spring between a point of a link and a place in the world, for a mouse that pulls a body.
#pragma once

#include "bubblesim/device.hpp"

namespace bubblesim {

/// Critically damped for the mass of the whole model, with a natural frequency of 1.5 Hz; the force is at most 50 times
/// that mass, in N per kg. Add it to a world without a rate.
class PointSpring final : public Device {
 public:
  /// Pulls this point of a link, m in its frame, to where it is now. Throws WrongObject for other objects than links of
  /// moving models, InvalidInput for a point that is not finite.
  void grip(const World& world, ObjectId link, const Vector3& point);
  /// Pulls to this place from now on; m, in the world. Throws InvalidInput when it is not finite.
  void pull_to(const Vector3& target);
  void release() { link_ = kNoObject; }

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  ObjectId link_ = kNoObject;
  Vector3 point_;  // in the link's frame
  Vector3 target_;
  double mass_ = 0;       // kg, of the model
  double link_mass_ = 0;  // kg
};

}  // namespace bubblesim
