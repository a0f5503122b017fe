// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer's entry: BUBBLESIM_FUZZ_TARGET names the target. For scripts/fuzz.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "targets.hpp"

namespace {

/// Ends the program unless the variable names a target.
const bubblesim::fuzz::Target& chosen() {
  const char* given = std::getenv("BUBBLESIM_FUZZ_TARGET");
  const std::string name = given == nullptr ? "" : given;
  for (const bubblesim::fuzz::Target& target : bubblesim::fuzz::targets()) {
    if (target.name == name) return target;
  }
  std::fprintf(stderr, "BUBBLESIM_FUZZ_TARGET names no target: '%s'\n", name.c_str());
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bubblesim::fuzz::Target& target = chosen();
  target.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
