// SPDX-License-Identifier: BSD-3-Clause
// How the registry makes a kind whose class only its own file knows.
#pragma once

#include <memory>

#include "bubblesim/sensor_definition.hpp"

namespace bubblesim {

/// The file of a kind instantiates it: template std::unique_ptr<SensorDefinition> define<ImuKind>();
template <class Kind>
std::unique_ptr<SensorDefinition> define() {
  return std::make_unique<Kind>();
}

}  // namespace bubblesim
