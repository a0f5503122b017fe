// SPDX-License-Identifier: BSD-3-Clause
// Limits of a scene file with all included files: SDFormat follows circular <include>s without end, and large files
// take hours and all memory.
#pragma once

#include <filesystem>
#include <sdf/ParserConfig.hh>
#include <string>
#include <vector>

#include "load/scene_xml.hpp"

namespace bubblesim {

/// Throws SceneError when the file is larger than the limit.
void check_size(const std::filesystem::path& file);

/// Checks a document before SDFormat reads it. Returns the included files; a file comes after the files that it
/// includes. Throws SceneError when a file includes itself, is not a regular file, or exceeds a limit.
std::vector<std::string> check_limits(const SceneXml& xml, const sdf::ParserConfig& config);

}  // namespace bubblesim
