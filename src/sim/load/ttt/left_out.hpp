// SPDX-License-Identifier: BSD-3-Clause
// What of a file does not come over, or changes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "load/ttt/structure.hpp"

namespace bubblesim::ttt {

/// Objects, by what happens to them: "graph: not shown" -> aliases. Parts that are no objects are counted in the text.
class LeftOut {
 public:
  void add(const std::string& what, const std::string& object) { objects_[what].push_back(object); }
  bool empty() const { return objects_.empty(); }
  /// A line for each: what, how many, and the first objects.
  std::vector<std::string> lines() const;

 private:
  std::map<std::string, std::vector<std::string>> objects_;
};

/// What the file itself has; a conversion adds to it what it cannot do.
LeftOut left_out_of(const SceneFile& file, const Structure& structure);

}  // namespace bubblesim::ttt
