// SPDX-License-Identifier: BSD-3-Clause
// Names in messages: lists of them, and "did you mean ...?" with the known names that are similar to a given one.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bubblesim {

/// "a, b or c" with the last separator " or ".
inline std::string joined(const std::vector<std::string>& names, const std::string& last_separator) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 < names.size() ? ", " : last_separator;
    list += names[i];
  }
  return list;
}

/// Levenshtein distance, ignoring case.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replace = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replace, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// Returns the names in `known` that are close to `name`: best match first, at most three.
inline std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& known) {
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance <= std::max<std::size_t>(2, name.size() / 3)) ranked.emplace_back(distance, candidate);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < ranked.size() && i < 3; ++i) names.push_back(ranked[i].second);
  return names;
}

/// Returns `; did you mean a, b?`, or an empty string when no name is close.
inline std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  const std::string hint = joined(nearest_names(name, known), ", ");
  return hint.empty() ? hint : "; did you mean " + hint + "?";
}

}  // namespace bubblesim
