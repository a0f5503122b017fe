// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace bubblesim {

/// A surface that cannot be made; the text says why.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The file that it is in is not there.
struct MissingFile : MeshError {
  using MeshError::MeshError;
};

}  // namespace bubblesim
