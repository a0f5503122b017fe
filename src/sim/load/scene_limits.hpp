// SPDX-License-Identifier: BSD-3-Clause
// What a scene file may hold, with all files that it includes: SDFormat follows an <include> for ever, and takes all
// memory and hours for what is large.
#pragma once

#include <filesystem>
#include <sdf/ParserConfig.hh>
#include <string>
#include <vector>

#include "load/scene_xml.hpp"

namespace bubblesim {

/// Throws SceneError when it is larger than scene files may be.
void check_size(const std::filesystem::path& file);

/// Looks at a document before SDFormat reads it. Returns the files that it includes, each after those that it includes
/// itself. Throws SceneError when one includes itself, is no regular file, or holds more than is read.
std::vector<std::string> check_limits(const SceneXml& xml, const sdf::ParserConfig& config);

}  // namespace bubblesim
