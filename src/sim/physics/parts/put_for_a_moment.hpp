// SPDX-License-Identifier: BSD-3-Clause
// Puts a body elsewhere, and back in the end: ODE takes the frames of its joints from the poses of the bodies.
#pragma once

#include "physics/ode/body_state.hpp"
#include "physics/ode/ode_math.hpp"
#include "physics/parts/link.hpp"

namespace bubblesim {

class PutForAMoment {
 public:
  PutForAMoment(const Link& link, const Pose& pose) : body_(link.body.get()), before_(body_pose(body_)) {
    set_body_pose(body_, {pose * link.centre_of_mass, pose.orientation});
  }
  ~PutForAMoment() { set_body_pose(body_, before_); }
  PutForAMoment(const PutForAMoment&) = delete;
  PutForAMoment& operator=(const PutForAMoment&) = delete;

 private:
  dBodyID body_;
  Pose before_;
};

}  // namespace bubblesim
