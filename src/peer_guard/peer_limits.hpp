// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace bubblesim {

/// A larger XML-RPC request or response closes its connection.
constexpr std::size_t kLargestXmlRpc = std::size_t{16} << 20;  // bytes
/// More deeply nested XML-RPC values are rejected.
constexpr int kDeepestXmlRpc = 100;

/// Without these limits, peers can make roscpp's libraries recurse as deeply as an XML-RPC value is nested (without end
/// for a system.multicall in a system.multicall), buffer everything that is sent, and read up to a megabyte past a
/// TCPROS header with wrong lengths. The limits are active from the start of the process; this function checks that.
/// Throws std::runtime_error for versions of the libraries that the limits were not made for.
void check_peer_limits();

}  // namespace bubblesim
