// SPDX-License-Identifier: BSD-3-Clause
// What URDF says and SDFormat refuses or drops without a word, which then is told.
#pragma once

#include <tinyxml2.h>

#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// The text of a reading's <robot> that SDFormat is to convert.
std::string prepared_urdf(LoadContext& reading);

/// Reads that text.
sdf::Errors load_urdf(sdf::Root& root, const sdf::ParserConfig& config, const std::string& prepared);

/// Lets go what <joint type="floating"> and "planar" hold, takes mimics over, and tells of all joints that SDFormat
/// left out. For a model of which load_urdf() made the root.
void finish_urdf(ModelDescription& model, LoadContext& reading);

}  // namespace bubblesim
