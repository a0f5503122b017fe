// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace bubblesim {

/// The folder of this library's file, from which its data is located in development and install spaces alike. Empty
/// when the loader does not know it.
std::filesystem::path library_folder();

}  // namespace bubblesim
