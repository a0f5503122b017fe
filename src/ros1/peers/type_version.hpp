// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// A type as known to a node: types of the same name may have different definitions, and so different md5 sums.
struct TypeVersion {
  std::string name;
  std::string type_hash;
};

inline std::string shown(const TypeVersion& type) { return type.name + " (md5 " + type.type_hash + ")"; }

/// What to do about two nodes with incompatible types.
inline std::string cure(const TypeVersion& theirs, const TypeVersion& ours) {
  if (theirs.name != ours.name) return "use the same type in both";
  return "the definitions differ: build the messages of both nodes from the same definition, and start both after "
         "sourcing that workspace";
}

}  // namespace bubblesim
