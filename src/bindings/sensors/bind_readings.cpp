// SPDX-License-Identifier: BSD-3-Clause
// The classes of sensor readings.
#include "bindings.hpp"
#include "sensors/record_class.hpp"

namespace bubblesim::bindings {

void bind_readings(pybind11::module_& core) { bind_record_classes(core); }

}  // namespace bubblesim::bindings
