// SPDX-License-Identifier: BSD-3-Clause
// Finds listed types with names similar to a misspelt type name.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "bubblesim/messages/registry.hpp"
#include "bubblesim/nearest_names.hpp"

namespace bubblesim::messages {
namespace {

constexpr std::size_t kWrongPackage = 100;  // ranks behind every name that only has typing errors
constexpr std::size_t kAtMost = 3;

struct NameParts {
  std::string_view package;
  std::string_view type;
};

/// `pkg/Type` and `pkg/msg/Type` give both parts, `Type` has an empty package.
NameParts split(std::string_view name) {
  const std::size_t first = name.find('/');
  if (first == name.npos) return {{}, name};
  return {name.substr(0, first), name.substr(name.rfind('/') + 1)};
}

bool close(std::size_t edits, std::string_view name) { return edits <= std::max<std::size_t>(2, name.size() / 3); }

std::vector<std::string> similar_names(std::string_view name, const std::vector<std::string>& known) {
  // Compare package and type separately: a long package name alone must not make two types similar.
  const NameParts wanted = split(name);
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& candidate : known) {
    const NameParts parts = split(candidate);
    const std::size_t type_edits = edit_distance(wanted.type, parts.type);
    if (!close(type_edits, wanted.type)) continue;
    const std::size_t package_edits = wanted.package.empty() ? 0 : edit_distance(wanted.package, parts.package);
    if (close(package_edits, wanted.package)) {
      ranked.emplace_back(type_edits + package_edits, candidate);
    } else if (type_edits == 0) {
      ranked.emplace_back(kWrongPackage, candidate);
    }
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::string> names;
  for (auto& [edits, candidate] : ranked) {
    // After a likely name, distant ones only distract.
    if (names.size() == kAtMost || edits > 2 * ranked.front().first + 2) break;
    names.push_back(std::move(candidate));
  }
  return names;
}

}  // namespace

std::vector<std::string> similar_message_names(std::string_view name, RosVersion version) {
  return similar_names(name, message_names(version));
}

std::vector<std::string> similar_service_names(std::string_view name, RosVersion version) {
  return similar_names(name, service_names(version));
}

}  // namespace bubblesim::messages
