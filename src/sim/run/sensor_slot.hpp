// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "bubblesim/sensor.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

/// A sensor of a simulation, and when it measures.
struct Simulation::SensorSlot {
  ObjectId id = kNoObject;
  std::unique_ptr<Sensor> sensor;
  double period = 0;    // s
  double due = 0;       // s, state_time() of the next measurement
  double time = 0;      // s, state_time() when it was last due, or last measured on request; at first of its creation
  bool wanted = false;  // it was read since its last measurement
  bool measured = false;
  bool shows = false;  // the image was replaced by override_image()
  double noise_scale = 1;

  void reset(double now) {
    sensor->reset();
    time = now;
    due = now + period;
    wanted = measured = shows = false;
  }
};

}  // namespace bubblesim
