// SPDX-License-Identifier: BSD-3-Clause
// What the process prints to stdout, and whether it arrived.
#pragma once

namespace bubblesim::app {

/// Occupies the standard descriptors that are closed, so that no file or socket gets their numbers, and with them what
/// is printed. Writing to stdout fails then as it did before. To be called before anything is opened.
void occupy_closed_descriptors();

/// Writes out what stdout holds. False, and a line on stderr, when it is full or closed.
bool flush_output();

}  // namespace bubblesim::app
