// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"

PYBIND11_MODULE(_core, core) {
  core.doc() = "The compiled part of bubblesim.";
  bubblesim::bindings::bind_messages(core);
}
