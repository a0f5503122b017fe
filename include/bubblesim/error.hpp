// SPDX-License-Identifier: BSD-3-Clause
// What can go wrong in the core. Every text says what, where, why and what to do.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace bubblesim {

/// A value that a caller handed in cannot be used; the world is unchanged.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A path or handle that names no object.
struct NoSuchObject : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// An object that a function cannot work on: one of another kind, an axis that its joint lacks, or a static model.
struct WrongObject : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// One thing that is wrong with a scene file.
struct Problem {
  std::string file;
  int line = 0;        ///< 0 when the parser does not know it
  std::string object;  ///< path such as /Tricycle/Steering, or empty
  std::string message;

  /// `file:line: /Object: message`, as editors and compilers write it.
  std::string text() const;
};

/// A scene that cannot be used, with all its problems at once.
struct SceneError : std::runtime_error {
  explicit SceneError(std::vector<Problem> found);
  std::vector<Problem> problems;
};

/// The physics left the finite world; the state can no longer be trusted.
struct Diverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace bubblesim
