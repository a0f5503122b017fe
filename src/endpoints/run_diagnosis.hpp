// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bubblesim/run_report.hpp"
#include "diagnosis.hpp"

namespace bubblesim {

/// Judges the reports of a run.
class RunDiagnosis {
 public:
  Diagnosis judge(const RunReport& report);

 private:
  int script_errors_ = 0;  // reported so far
};

}  // namespace bubblesim
