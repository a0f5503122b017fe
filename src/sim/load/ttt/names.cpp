// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/names.hpp"

#include <cctype>

namespace bubblesim::ttt {

std::string plain_name(const std::string& name) {
  constexpr std::size_t kLongest = 100;
  std::string plain = name.substr(0, kLongest);
  for (char& sign : plain) {
    if (std::isalnum(static_cast<unsigned char>(sign)) == 0 && sign != '-') sign = '_';
  }
  return plain.empty() ? "object" : plain;
}

std::string UniqueNames::take(const std::string& name) {
  std::string own = plain_name(name);
  const std::string base = own;
  int& number = last_.try_emplace(base, 1).first->second;
  while (!taken_.insert(own).second) own = base + "_" + std::to_string(++number);
  return own;
}

}  // namespace bubblesim::ttt
