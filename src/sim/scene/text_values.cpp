// SPDX-License-Identifier: BSD-3-Clause
#include "scene/text_values.hpp"

#include <cctype>
#include <cstdlib>

namespace bubblesim {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kSpace) - first + 1));
}

bool read_numbers(std::string_view text, std::vector<double>& numbers) {
  const std::string buffer(text);
  const auto is_space = [](char character) { return std::isspace(static_cast<unsigned char>(character)) != 0; };
  for (const char* at = buffer.c_str();;) {
    while (is_space(*at)) ++at;
    if (*at == '\0') return true;
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) return false;
    numbers.push_back(number);
    if (*end != '\0' && !is_space(*end)) return false;
    at = end;
  }
}

}  // namespace bubblesim
