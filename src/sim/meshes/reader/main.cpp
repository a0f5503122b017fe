// SPDX-License-Identifier: BSD-3-Clause
// The program mesh_reader: reads mesh files for a simulator in a separate process, because assimp crashes or uses all
// memory on some damaged files. Ends when the simulator closes its socket.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <new>
#include <string>

#include "meshes/mesh_content.hpp"
#include "meshes/mesh_limits.hpp"
#include "meshes/mesh_stream.hpp"
#include "meshes/reader/assimp_file.hpp"

namespace bubblesim {
namespace {

/// Address space of this process in bytes.
std::uint64_t memory_in_use() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_memory_limit(std::uint64_t bytes) {
#if !defined(__SANITIZE_ADDRESS__)  // it uses terabytes of address space
  rlimit limit{bytes, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &limit);
#else
  static_cast<void>(bytes);
#endif
}

/// Sets limits for the next file: the kernel kills the process when it exceeds its CPU time, and denies more memory.
void set_limits(const MeshQuery& query) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1);
  rlimit time{seconds + mesh_seconds(query.size), RLIM_INFINITY};
  ::setrlimit(RLIMIT_CPU, &time);
  set_memory_limit(memory_in_use() + mesh_memory(query.size));
}

void send(MeshStream& stream, const MeshContent& content) {
  const auto step = [&stream](const auto& value) { stream.send(value); };
  each_array(content, step);
  stream.send(static_cast<std::uint64_t>(content.materials.size()));
  for (const FileMaterial& material : content.materials) each_part(material, step);
}

MeshContent answer(AssimpFile& file, const MeshQuery& query) {
  file.prepare(query);
  set_limits(query);
  std::string error;
  try {
    return file.read(query);
  } catch (const std::bad_alloc&) {
    error = "cannot be read as a mesh: it takes more than " + std::to_string(mesh_memory(query.size) >> 20U) +
            " MB of memory; the file is damaged";
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  set_memory_limit(RLIM_INFINITY);
  MeshContent failed;
  failed.error = std::move(error);
  return failed;
}

int serve(int socket) {
  MeshStream stream(socket);
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

bool is_socket(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

}  // namespace
}  // namespace bubblesim

int main() {
  if (!bubblesim::is_socket(STDIN_FILENO)) {
    std::fputs("mesh_reader is started by bubblesim to read the mesh files of a scene; it cannot be run directly\n",
               stderr);
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with the simulator
  ::signal(SIGINT, SIG_IGN);           // a terminal sends it to both processes
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  ::_exit(bubblesim::serve(STDIN_FILENO));  // faster than freeing the last file
}
