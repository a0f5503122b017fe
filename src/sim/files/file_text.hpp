// SPDX-License-Identifier: BSD-3-Clause
// The content of a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bubblesim {

/// Returns all bytes of a file; empty when it cannot be read.
std::string read_text(const std::filesystem::path& file);

/// Writes a file, and makes the folders above it. Throws std::runtime_error when that fails.
void write_file(const std::filesystem::path& file, const std::string& content);

/// The lines of a string, without their ends.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace bubblesim
