// SPDX-License-Identifier: BSD-3-Clause
#include "targets.hpp"

namespace bubblesim::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> kTargets = {
      {"cbor", read_cbor},       {"material", read_material}, {"mesh", read_mesh},         {"message", read_message},
      {"picture", read_picture}, {"scene", read_scene},       {"snapshot", read_snapshot}, {"ttt", read_ttt},
  };
  return kTargets;
}

}  // namespace bubblesim::fuzz
