// SPDX-License-Identifier: BSD-3-Clause
// Handles URDF that SDFormat rejects or drops silently, and reports it.
#pragma once

#include <tinyxml2.h>

#include <sdf/Error.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/Root.hh>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// The text of the <robot> for SDFormat.
std::string prepared_urdf(LoadContext& reading);

/// Reads that text.
sdf::Errors load_urdf(sdf::Root& root, const sdf::ParserConfig& config, const std::string& prepared);

/// Frees the children of <joint type="floating"> and "planar", reads mimics, and reports all joints that SDFormat
/// dropped. For a model from load_urdf().
void finish_urdf(ModelDescription& model, LoadContext& reading);

}  // namespace bubblesim
