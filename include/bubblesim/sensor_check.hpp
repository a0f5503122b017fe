// SPDX-License-Identifier: BSD-3-Clause
// Checks the description of a sensor, for its kind.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"

namespace bubblesim {

class Checker;

class SensorCheck {
 public:
  /// `link` is null for a sensor of a joint.
  SensorCheck(Checker& checker, const LinkDescription* link) : checker_(checker), link_(link) {}

  /// Reports that WHAT is FOUND but must be WANTED, unless it is fine.
  void require(bool fine, const std::string& what, const std::string& found, const std::string& wanted);
  void report(std::string message);
  /// Of a sensor with rays, m.
  void require_ranges(double min_range, double max_range);
  const LinkDescription* link() const { return link_; }

 private:
  Checker& checker_;
  const LinkDescription* link_;
};

}  // namespace bubblesim
