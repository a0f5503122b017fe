// SPDX-License-Identifier: BSD-3-Clause
// Devices that Python adds to a world.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "bubblesim/device.hpp"
#include "guarded.hpp"

namespace bubblesim::bindings {

using Numbers3 = std::array<double, 3>;

inline Vector3 to_vector3(const Numbers3& v) { return {v[0], v[1], v[2]}; }

/// A device that Python added to a world.
template <class Kind>
struct Attached {
  World& world;
  std::shared_ptr<Kind> device;

  void remove() { world.devices().remove(*device); }
};

template <class Kind>
AccessLock& lock_of(const Attached<Kind>& attached) {
  return attached.world.access();
}

template <class Kind>
Attached<Kind> attach(World& world, std::shared_ptr<Kind> device, ObjectId model, double rate) {
  const HoldWithGil hold(world.access());
  world.devices().add(device, model, rate);
  return {world, std::move(device)};
}

/// Makes a device and adds it for each substep, until the model of `object` is removed.
template <class Kind, class Make>
Attached<Kind> attach_to_model_of(ObjectId object, Simulation& simulation, const Make& make) {
  World& world = simulation.world();
  const HoldWithGil hold(world.access());
  auto device = std::shared_ptr<Kind>(make(world));
  world.devices().add(device, world.tree().outermost_model_of(object));
  return {world, std::move(device)};
}

}  // namespace bubblesim::bindings
