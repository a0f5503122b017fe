// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace bubblesim {

/// A mesh cannot be made; the text has the reason.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The file of the mesh does not exist.
struct MissingFile : MeshError {
  using MeshError::MeshError;
};

}  // namespace bubblesim
