// SPDX-License-Identifier: BSD-3-Clause
// Names that are safe in paths, files and XML, made of names in foreign files.
#pragma once

#include <map>
#include <set>
#include <string>

namespace bubblesim::ttt {

/// Letters, digits, _ and - remain, others become _; never empty, at most 100 characters.
std::string plain_name(const std::string& name);

/// A name as paths of scripts may have it, in UTF-8: control characters, / [ ] { } *, and a . or : at the start become
/// _.
std::string path_name(const std::string& name);

/// Gives each name once; further ones get _2, _3 ...
class UniqueNames {
 public:
  std::string take(const std::string& name);

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> last_;  // numbers given, by name
};

}  // namespace bubblesim::ttt
