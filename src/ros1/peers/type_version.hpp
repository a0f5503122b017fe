// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// A type as a node knows it: two that share a name may have different definitions, and then different md5 sums.
struct TypeVersion {
  std::string name;
  std::string md5;
};

inline std::string shown(const TypeVersion& type) { return type.name + " (md5 " + type.md5 + ")"; }

/// The cure for two nodes that cannot talk because of their types.
inline std::string cure(const TypeVersion& theirs, const TypeVersion& ours) {
  if (theirs.name != ours.name) return "let both use one type";
  return "their definitions differ: build the messages of both nodes from the same definition, and start both after "
         "sourcing that workspace";
}

}  // namespace bubblesim
