// SPDX-License-Identifier: BSD-3-Clause
// Exceptions of the core. Every message states what is wrong, where, why and what to do.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bubblesim {

/// The caller passed a value that cannot be used; the world is unchanged.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// A path or handle does not refer to an object.
struct NoSuchObject : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// An object that a function cannot work on: one of another kind, an axis that its joint lacks, or a static model.
struct WrongObject : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// Returns the noun with its indefinite article, for messages: "a lidar", "an IMU".
std::string with_article(std::string_view noun);

/// The text of the exception that is being handled; of one that is not derived from std::exception, that it is not.
std::string text_of_handled_exception();

/// One error in a scene file, or one warning.
struct Problem {
  std::string file;
  int line = 0;        ///< 0 when unknown
  std::string object;  ///< path such as /Tricycle/Steering, or empty
  std::string message;

  /// Returns `file:line: /Object: message`, the format of editors and compilers.
  std::string text() const;
};

/// A scene cannot be used. Lists all its problems.
struct SceneError : std::runtime_error {
  explicit SceneError(std::vector<Problem> found, std::vector<Problem> warnings = {});
  std::vector<Problem> problems;
  std::vector<Problem> warnings;  ///< of the parts that could be read
};

/// The physics diverged: a body left the finite world. The state can no longer be trusted.
struct Diverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A command to a Runner was not carried out; the message states why and what to do.
struct NotCarriedOut : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace bubblesim
