// SPDX-License-Identifier: BSD-3-Clause
// CBOR (RFC 8949) of remote clients to Python's values and back, as far as the protocol needs it: numbers, strings,
// bytes, lists, maps, None, booleans.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

namespace bubblesim::bindings {

/// Raises ValueError for what is not one such value, and for more than the request of an unknown client may cost: see
/// check_cbor.
pybind11::object cbor_decode(const pybind11::bytes& data);

/// Arrays of numpy become bytes and its numbers become numbers; raises TypeError for values of other types.
pybind11::bytes cbor_encode(const pybind11::handle& value);

}  // namespace bubblesim::bindings
