// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/names.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace bubblesim::ttt {

std::string plain_name(const std::string& name) {
  constexpr std::size_t kLongest = 100;
  std::string plain = name.substr(0, kLongest);
  for (char& sign : plain) {
    if (std::isalnum(static_cast<unsigned char>(sign)) == 0 && sign != '-') sign = '_';
  }
  return plain.empty() ? "object" : plain;
}

namespace {

/// The bytes of the character of UTF-8 at a place; 0 if there is none.
std::size_t character_at(std::string_view text, std::size_t i) {
  const auto first = static_cast<unsigned char>(text[i]);
  const std::size_t size = first < 0x80 ? 1 : first >= 0xc2 && first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if ((first >= 0x80 && first < 0xc2) || first >= 0xf5 || i + size > text.size()) return 0;
  for (std::size_t k = 1; k < size; ++k) {
    if ((static_cast<unsigned char>(text[i + k]) & 0xc0U) != 0x80) return 0;
  }
  return size;
}

}  // namespace

std::string path_name(const std::string& name) {
  constexpr std::size_t kLongest = 255;
  std::string kept;
  for (std::size_t i = 0; i < name.size() && kept.size() < kLongest;) {
    const std::size_t size = character_at(name, i);
    const auto sign = static_cast<unsigned char>(name[i]);
    const bool is_special = sign < ' ' || sign == 0x7f ||
                            std::string_view("/[]{}*").find(name[i]) != std::string::npos ||
                            (kept.empty() && (sign == '.' || sign == ':'));
    if (size == 0 || is_special) {
      kept += '_';
    } else {
      kept += name.substr(i, size);
    }
    i += std::max<std::size_t>(size, 1);
  }
  // Spaces at the ends would be lost in XML.
  if (!kept.empty() && kept.front() == ' ') kept.front() = '_';
  if (!kept.empty() && kept.back() == ' ') kept.back() = '_';
  return kept.empty() ? "object" : kept;
}

std::string UniqueNames::take(const std::string& name) {
  std::string own = plain_name(name);
  const std::string base = own;
  int& number = last_.try_emplace(base, 1).first->second;
  while (!taken_.insert(own).second) own = base + "_" + std::to_string(++number);
  return own;
}

}  // namespace bubblesim::ttt
