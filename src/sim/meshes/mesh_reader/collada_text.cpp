// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_reader/collada_text.hpp"

#include <algorithm>

namespace bubblesim {

std::string plain_collada(const std::string& text) {
  constexpr const char* kSpace = " \t\r\n";
  const auto end_of = [&text](const char* mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string::npos ? text.size() : found + std::char_traits<char>::length(mark);
  };
  std::string plain;
  plain.reserve(text.size());
  std::size_t at = 0;
  while (at < text.size()) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = end_of("-->", at + 4);
    } else if (text[at] == '<') {
      const std::size_t end = end_of(text.compare(at, 9, "<![CDATA[") == 0 ? "]]>" : ">", at);
      plain.append(text, at, end - at);
      at = std::min(text.find_first_not_of(kSpace, end), text.size());
    } else {
      const std::size_t end = std::min(text.find('<', at), text.size());
      plain.append(text, at, end - at);
      at = end;
    }
  }
  return plain;
}

}  // namespace bubblesim
