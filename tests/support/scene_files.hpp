// SPDX-License-Identifier: BSD-3-Clause
// Scene files that a test writes.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"

namespace bubblesim::test {

namespace fs = std::filesystem;

/// A temporary file, deleted at the end of the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : folder_(fs::temp_directory_path() / ("bubblesim_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    std::ofstream(path_ = folder_ / name) << text;
  }
  ~TemporaryFile() { fs::remove_all(folder_); }
  std::string path() const { return path_.string(); }
  std::string folder() const { return folder_.string(); }

 private:
  fs::path folder_;
  fs::path path_;
};

/// The strings of warnings, one a line.
inline std::string lines_of(const std::vector<Problem>& warnings) {
  std::string lines;
  for (const Problem& warning : warnings) lines += warning.text() + "\n";
  return lines;
}

inline std::string in_world(const std::string& text) {
  return "<sdf version='1.9' xmlns:bubblesim='https://bubblesim'><world name='w'>" + text + "</world></sdf>";
}

}  // namespace bubblesim::test
