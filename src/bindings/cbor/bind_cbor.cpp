// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "cbor/cbor_codec.hpp"

namespace bubblesim::bindings {

namespace py = pybind11;

void bind_cbor(py::module_& module) {
  module.def("cbor_decode", &cbor_decode, py::arg("data"),
             "Return the value of bytes in CBOR: numbers, strings, bytes, lists, maps, None, booleans.\n\n"
             ":raises ValueError: for what is not one such value, and for more than 32 levels, 200,000 values, 4,096 "
             "entries in "
             "a map, 1,000 keys that are no strings, or 4 MiB of strings.");
  module.def("cbor_encode", &cbor_encode, py::arg("value"),
             "Return the CBOR of a value; arrays and other buffers become bytes.\n\n"
             ":raises TypeError: for values of other types, and for more than 100 levels.");
}

}  // namespace bubblesim::bindings
