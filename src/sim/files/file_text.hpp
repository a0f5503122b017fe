// SPDX-License-Identifier: BSD-3-Clause
// The content of a file.
#pragma once

#include <filesystem>
#include <string>

namespace bubblesim {

/// Returns all bytes of a file; empty when it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace bubblesim
