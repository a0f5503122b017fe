// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_reader.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "meshes/mesh_error.hpp"
#include "meshes/mesh_limits.hpp"
#include "meshes/reader_stream.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

std::uint64_t digest_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t kPart = 1U << 20U;
  std::vector<char> buffer(sizeof(std::uint64_t) + kPart);  // each part is preceded by the digest of the earlier parts
  std::uint64_t digest = 0;
  while (stream.read(buffer.data() + sizeof digest, kPart), stream.gcount() > 0) {
    std::memcpy(buffer.data(), &digest, sizeof digest);
    digest = std::hash<std::string_view>()({buffer.data(), sizeof digest + static_cast<std::size_t>(stream.gcount())});
  }
  if (stream.bad() || !stream.eof()) throw MeshError("cannot be read");
  return digest;
}

/// Throws StreamClosed and StreamTimeout.
MeshContent ask(int socket, const MeshQuery& query) {
  ReaderStream stream(socket);
  // The reader limits its own CPU time; this limit is for a reader that waits.
  stream.set_deadline(ReaderStream::Clock::now() + std::chrono::seconds(30 + 4 * mesh_seconds(query.size)));
  each_value(query, [&stream](const auto& value) { stream.send(value); });
  MeshContent content;
  const auto step = [&stream](auto& value) { stream.receive(value); };
  each_array(content, step);
  std::uint64_t materials = 0;
  stream.receive(materials);
  for (std::uint64_t i = 0; i < materials; ++i) each_part(content.materials.emplace_back(), step);
  return content;
}

}  // namespace

const MeshReader::Content& MeshReader::content(const std::string& file) {
  const auto [found, is_new] = contents_.try_emplace(file);
  if (!is_new) return found->second;
  try {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      throw MeshError(fs::exists(file, error) ? "is not a regular file" : "does not exist");
    }
    const std::uint64_t size = fs::file_size(file, error);
    if (error) throw MeshError("cannot be read (" + error.message() + ")");
    if (size > kLargestMeshFile) {
      throw MeshError("is " + std::to_string(size / kMegabyte) + " MB large; the maximum is " +
                      std::to_string(kLargestMeshFile / kMegabyte) + " MB");
    }
    found->second = {size, digest_of(file)};
  } catch (const MeshError&) {
    contents_.erase(found);
    throw;
  }
  return found->second;
}

MeshContent MeshReader::read(const MeshQuery& query) {
  if (process_ == nullptr) process_ = std::make_unique<ReaderProcess>("mesh_reader");
  try {
    MeshContent content = ask(process_->socket(), query);
    if (!content.error.empty() && content.part_names.empty()) throw MeshError(content.error);
    return content;
  } catch (const StreamClosed&) {
    const std::string reason = std::exchange(process_, nullptr)->reason_of_end(mesh_seconds(query.size));
    throw MeshError("cannot be read as a mesh (" + reason + "): the file is damaged");
  } catch (const StreamTimeout&) {
    process_.reset();
    throw MeshError("cannot be read as a mesh (its reader does not answer): the file is damaged, or its disk is slow");
  }
}

}  // namespace bubblesim
