// SPDX-License-Identifier: BSD-3-Clause
// Checks the process's output to stdout.
#pragma once

namespace bubblesim::app {

/// Opens the closed standard descriptors, so that no file or socket gets their numbers and receives the printed output.
/// Writing to stdout still fails. Call it before anything is opened.
void occupy_closed_descriptors();

/// Flushes stdout. Returns false and prints an error to stderr if it is full or closed.
bool flush_output();

}  // namespace bubblesim::app
