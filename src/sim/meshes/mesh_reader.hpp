// SPDX-License-Identifier: BSD-3-Clause
// Reads mesh files in another process, which may crash or be killed at its limits.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "meshes/mesh_content.hpp"
#include "meshes/reader_process.hpp"

namespace bubblesim {

/// One process for all files of a load. It is started with the first file and again after a file that made it crash.
class MeshReader {
 public:
  /// Identifies the content of a file.
  struct Content {
    std::uint64_t size = 0;  ///< bytes
    std::uint64_t digest = 0;
  };
  /// Computed once per file and reader. Throws MeshError when it is not a regular file or too large.
  const Content& content(const std::string& file);

  /// Throws MeshError when the mesh cannot be read, also when the reader process crashes.
  MeshContent read(const MeshQuery& query);

 private:
  std::unique_ptr<ReaderProcess> process_;
  std::map<std::string, Content> contents_;
};

}  // namespace bubblesim
