// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace bubblesim {

/// The folder that this library was loaded from: what belongs to it is found from there, in development and install
/// spaces alike. Empty when the loader does not know.
std::filesystem::path library_folder();

}  // namespace bubblesim
