// SPDX-License-Identifier: BSD-3-Clause
#include "diagnosis.hpp"

#include <algorithm>

namespace bubblesim {

void Diagnosis::merge(Level other, const std::string& text) {
  if (level > kOk && other > kOk) {
    message += "; " + text;
  } else if (other > level) {
    message = text;
  }
  level = std::max<int>(level, other);
}

}  // namespace bubblesim
