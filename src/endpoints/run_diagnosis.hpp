// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bubblesim/run_report.hpp"

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

/// Judges the reports of a run.
class RunDiagnosis {
 public:
  Diagnosis judge(const RunReport& report);

 private:
  int script_errors_ = 0;  // reported so far
};

}  // namespace bubblesim
