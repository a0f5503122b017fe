// SPDX-License-Identifier: BSD-3-Clause
// How scripts and remote clients see the objects of a file: <bubblesim:alias> and <bubblesim:axis_convention>.
#pragma once

#include <sdf/Element.hh>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// The alias of an element, or that of its <include>; empty if it has none or one that is not a name.
std::string read_alias(const sdf::ElementPtr& element, const std::string& path, LoadContext& reading);

/// The axis convention of a world or model, or that of its <include>; by default that of the context.
AxisConvention read_axis_convention(const sdf::ElementPtr& element, const std::string& path, LoadContext& reading);

}  // namespace bubblesim
