// SPDX-License-Identifier: BSD-3-Clause
#include "cbor/cbor_reader.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {

void read_cbor(std::string_view data) {
  try {
    bindings::check_cbor(data);
  } catch (const bindings::CborError&) {
    return;
  }
  bindings::CborReader reader(data);  // what was checked is read to its end without errors
  while (!reader.at_end()) reader.next();
}

}  // namespace bubblesim::fuzz
