// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace bubblesim {

/// A request or an answer of XML-RPC that is larger ends its connection.
constexpr std::size_t kLargestXmlRpc = std::size_t{16} << 20;  // bytes
/// Values that XML-RPC nests deeper are not read.
constexpr int kDeepestXmlRpc = 100;

/// What roscpp's libraries leave to peers without these limits: they recurse as deeply as an XML-RPC value is nested,
/// without end for a system.multicall in a system.multicall, buffer as much as is sent, and read up to a megabyte
/// behind a TCPROS header whose lengths lie. The limits hold from the start of the process; this makes sure of it.
/// Throws std::runtime_error when the libraries are others than those that the limits were made for.
void check_peer_limits();

}  // namespace bubblesim
