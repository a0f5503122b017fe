// SPDX-License-Identifier: BSD-3-Clause
// Sensor readings that Python objects keep alive.
#pragma once

#include <memory>
#include <variant>

#include "bubblesim/sensor.hpp"

namespace bubblesim::bindings {

/// A measurement of one kind, kept unchanged as long as Python holds it or one of its arrays.
template <class Kind>
struct Held {
  std::shared_ptr<const Reading> reading;

  const Kind& operator*() const { return std::get<Kind>(reading->measurement); }
  const Kind* operator->() const { return &**this; }
};

using HeldScan = Held<LidarScan>;
using HeldImage = Held<CameraImage>;
using HeldImu = Held<ImuReading>;
using HeldNavSat = Held<NavSatReading>;
using HeldAltimeter = Held<AltimeterReading>;
using HeldMagnetometer = Held<MagnetometerReading>;
using HeldContacts = Held<ContactReading>;
using HeldForceTorque = Held<ForceTorqueReading>;

}  // namespace bubblesim::bindings
