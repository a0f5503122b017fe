// SPDX-License-Identifier: BSD-3-Clause
// Strings, and the numbers in them, as files have them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bubblesim {

/// The text without white space at its ends.
std::string trimmed(std::string_view text);

/// Appends the numbers in a string, separated by spaces, with "inf" and "nan", infinite beyond the range of double.
/// Returns false when other content follows; the numbers before it are read.
bool read_numbers(std::string_view text, std::vector<double>& numbers);

}  // namespace bubblesim
