// SPDX-License-Identifier: BSD-3-Clause
// Loads a scene for Python.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "bubblesim/scene_loader.hpp"

namespace bubblesim::bindings {

using NamedArguments = std::map<std::string, std::string>;

/// Throws SceneError.
std::shared_ptr<const Scene> loaded_scene(const std::string& name_or_path, const NamedArguments& named);

}  // namespace bubblesim::bindings
