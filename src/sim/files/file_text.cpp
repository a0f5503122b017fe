// SPDX-License-Identifier: BSD-3-Clause
#include "files/file_text.hpp"

#include <fstream>
#include <sstream>

namespace bubblesim {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  return std::move(text).str();
}

}  // namespace bubblesim
