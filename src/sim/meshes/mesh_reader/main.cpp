// SPDX-License-Identifier: BSD-3-Clause
// The program mesh_reader: reads mesh files for a simulator in a separate process, because assimp crashes or uses all
// memory on some damaged files. Ends when the simulator closes its socket.
#include <unistd.h>

#include <exception>
#include <new>
#include <string>

#include "meshes/mesh_content.hpp"
#include "meshes/mesh_limits.hpp"
#include "meshes/mesh_reader/assimp_file.hpp"
#include "meshes/reader_program.hpp"
#include "meshes/reader_stream.hpp"

namespace bubblesim {
namespace {

void send(ReaderStream& stream, const MeshContent& content) {
  const auto step = [&stream](const auto& value) { stream.send(value); };
  each_array(content, step);
  stream.send(static_cast<std::uint64_t>(content.materials.size()));
  for (const FileMaterial& material : content.materials) each_part(material, step);
}

MeshContent answer(AssimpFile& file, const MeshQuery& query) {
  file.prepare(query);
  set_limits(mesh_seconds(query.size), mesh_memory(query.size));
  std::string error;
  try {
    return file.read(query);
  } catch (const std::bad_alloc&) {
    error = "cannot be read as a mesh: it takes more than " + std::to_string(mesh_memory(query.size) >> 20U) +
            " MB of memory; the file is damaged";
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  lift_memory_limit();
  MeshContent failed;
  failed.error = std::move(error);
  return failed;
}

int serve(int socket) {
  ReaderStream stream(socket);
  AssimpFile file;
  try {
    for (;;) {
      MeshQuery query;
      each_value(query, [&stream](auto& value) { stream.receive(value); });
      send(stream, answer(file, query));
    }
  } catch (const StreamClosed&) {
    return 0;
  }
}

}  // namespace
}  // namespace bubblesim

int main() {
  if (!bubblesim::begin_reading("mesh_reader", "mesh files")) return 2;
  ::_exit(bubblesim::serve(STDIN_FILENO));  // faster than freeing the last file
}
