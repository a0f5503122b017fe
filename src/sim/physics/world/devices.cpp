// SPDX-License-Identifier: BSD-3-Clause
// Devices: when each is due, and the wrenches that it applies.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "bubblesim/device.hpp"
#include "bubblesim/error.hpp"
#include "physics/world/state.hpp"
#include "scene/describe.hpp"

namespace bubblesim {
namespace {

/// Directs wrenches to a device during its update.
class Updating {
 public:
  Updating(WorldState& state, DeviceSlot& slot) : state_(state) { state_.updating = &slot; }
  ~Updating() { state_.updating = nullptr; }
  Updating(const Updating&) = delete;
  Updating& operator=(const Updating&) = delete;

 private:
  WorldState& state_;
};

void check_not_updating(const WorldState& state) {
  if (state.updating == nullptr) return;
  throw std::logic_error("a device cannot add or remove devices in its update; do it between steps");
}

}  // namespace

void Device::reset(World&) {}
void Device::transfer(StateArchive&) {}

void update_devices(World& world, WorldState& state, double time, double step) {
  for (DeviceSlot& slot : state.devices) {
    if (slot.substeps == 0) {
      const double due = slot.ahead + slot.period;
      slot.substeps = std::max(std::lround(due / step), 1L);
      const double duration = static_cast<double>(slot.substeps) * step;
      slot.ahead = std::max(due - duration, -step / 2);  // a rate above that of the substeps is not made up for
      slot.wrenches.clear();
      const Updating updating(state, slot);
      slot.device->update(world, time, duration);
    }
    --slot.substeps;
  }
}

void reset_devices(World& world, std::vector<DeviceSlot> devices, WorldState& state) {
  state.devices = std::move(devices);
  for (DeviceSlot& slot : state.devices) {
    slot.substeps = 0;
    slot.ahead = 0;
    slot.wrenches.clear();
  }
  for (DeviceSlot& slot : state.devices) slot.device->reset(world);
}

void remove_devices(WorldState& state, ObjectId model) {
  auto& devices = state.devices;
  const auto of_model = [&](const DeviceSlot& slot) { return slot.model == model; };
  devices.erase(std::remove_if(devices.begin(), devices.end(), of_model), devices.end());
}

void WorldDevices::add(std::shared_ptr<Device> device, ObjectId model, double rate) {
  check_not_updating(state());
  if (device == nullptr) throw InvalidInput("add_device needs a device, not a null pointer");
  if (model != kNoObject) {
    const Object& object = state().tree().at(model);
    if (!object.is_outermost_model()) {
      throw WrongObject(state().shown(model) + " is a " + std::string(kind_name(object.kind)) +
                        ": a device belongs to an outermost model or to the world");
    }
  }
  if (!(rate >= 0 && std::isfinite(rate))) {
    throw InvalidInput("the rate " + text(rate) + " Hz of a device is not usable: it must be zero or more");
  }
  DeviceSlot& slot = state().devices.emplace_back();
  slot.device = std::move(device);
  slot.model = model;
  slot.period = rate > 0 ? 1 / rate : 0;
}

void WorldDevices::remove(const Device& device) {
  check_not_updating(state());
  auto& devices = state().devices;
  const auto is_it = [&](const DeviceSlot& slot) { return slot.device.get() == &device; };
  devices.erase(std::remove_if(devices.begin(), devices.end(), is_it), devices.end());
}

void WorldDevices::set_contact_filter(ContactFilter filter) {
  check_not_updating(state());
  state().contacts.filter = std::move(filter);
}

}  // namespace bubblesim
