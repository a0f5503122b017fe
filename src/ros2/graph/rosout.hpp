// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "dds/participant.hpp"

namespace bubblesim::ros2 {

/// The log of this node: stderr and /rosout. Thread-safe.
class Rosout {
 public:
  /// The numbers are those of rcl_interfaces/Log.
  enum class Level : std::uint8_t { kInfo = 20, kWarn = 30, kError = 40 };

  Rosout(Participant& participant, std::string node);

  /// Writes a line.
  void log(Level level, const std::string& text);

 private:
  const std::string node_;
  Writer writer_;
};

}  // namespace bubblesim::ros2
