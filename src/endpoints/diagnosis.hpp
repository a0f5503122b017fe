// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bubblesim {

/// The content of a diagnostic_msgs/DiagnosticStatus; the levels have its numbers.
struct Diagnosis {
  enum Level { kOk = 0, kWarn = 1, kError = 2 };

  int level = kOk;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;

  /// As diagnostic_updater: the message of a worse level replaces that of kOk, others are joined.
  void merge(Level other, const std::string& text);
};

}  // namespace bubblesim
