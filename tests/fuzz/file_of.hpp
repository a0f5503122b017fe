// SPDX-License-Identifier: BSD-3-Clause
// Bytes as a file, for readers that take a path.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace bubblesim::fuzz {

/// A file in a folder of its own, in memory where the system has such a place. It is removed at the end.
class FileOf {
 public:
  explicit FileOf(const std::string& name) {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path base = exists(memory) ? memory : std::filesystem::temp_directory_path();
    std::string folder = (base / "fuzz-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr)
      throw std::filesystem::filesystem_error("mkdtemp", folder, std::error_code());
    file_ = std::filesystem::path(folder) / name;
  }
  ~FileOf() {
    std::error_code ignored;
    std::filesystem::remove_all(file_.parent_path(), ignored);
  }
  FileOf(const FileOf&) = delete;
  FileOf& operator=(const FileOf&) = delete;

  void write(std::string_view data) const {
    std::ofstream(file_, std::ios::binary | std::ios::trunc)
        .write(data.data(), static_cast<std::streamsize>(data.size()));
  }
  const std::filesystem::path& path() const { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace bubblesim::fuzz
