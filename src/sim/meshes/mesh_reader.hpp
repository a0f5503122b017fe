// SPDX-License-Identifier: BSD-3-Clause
// Reads mesh files in another process, which may crash or be ended for taking too much.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "meshes/mesh_content.hpp"

namespace bubblesim {

/// One process for all files of a load, started with the first and again after one that it did not survive.
class MeshReader {
 public:
  MeshReader();
  ~MeshReader();
  MeshReader(const MeshReader&) = delete;
  MeshReader& operator=(const MeshReader&) = delete;

  /// What identifies the content of a file.
  struct Content {
    std::uint64_t size = 0;  ///< bytes
    std::uint64_t digest = 0;
  };
  /// Looked at once in the life of this reader. Throws MeshError when it is no regular file or too large.
  const Content& content(const std::string& file);

  /// Throws MeshError when it cannot be read, whatever happens to the process that reads it.
  MeshContent read(const MeshQuery& query);

 private:
  class Process;
  std::unique_ptr<Process> process_;
  std::map<std::string, Content> contents_;
};

}  // namespace bubblesim
