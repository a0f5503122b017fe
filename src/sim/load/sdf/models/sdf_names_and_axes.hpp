// SPDX-License-Identifier: BSD-3-Clause
// How scripts and remote clients see the objects of a file: <bubblesim:alias> and <bubblesim:axis_convention>.
#pragma once

#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The alias of an element; empty if it has none or one that is not a name.
std::string read_alias(const SdfElement& element, const std::string& path, LoadContext& context);

/// The axis convention of a world or model; by default that of the context.
AxisConvention read_axis_convention(const SdfElement& element, const std::string& path, LoadContext& context);

}  // namespace bubblesim
