// SPDX-License-Identifier: BSD-3-Clause
// The outermost layer of CoppeliaSim's files (.ttt, .ttm): a header and one payload.
#pragma once

#include <string>
#include <string_view>

namespace bubblesim::ttt {

/// The newest version of the format that is known: V4.10's.
constexpr int kNewestFormat = 25;

struct Container {
  int serialization = 0;    ///< version of the format, 13 or later
  int program_version = 0;  ///< major * 10000 + minor * 100 + patch; 0: not in the header
  std::string content;      ///< the unpacked payload
};

/// Throws FormatError: no such file, a version that is not known, a size that cannot be.
Container open_container(std::string_view file);

}  // namespace bubblesim::ttt
