// SPDX-License-Identifier: BSD-3-Clause
// The program scene_converter: reads files of CoppeliaSim for a simulator in a separate process, which may crash or be
// killed at its limits.
#include <sys/resource.h>

#include <filesystem>
#include <iostream>
#include <new>
#include <string>

#include "files/file_text.hpp"
#include "load/ttt/bytes.hpp"
#include "load/ttt/describe.hpp"
#include "load/ttt/write_scene.hpp"

namespace bubblesim::ttt {
namespace {

namespace fs = std::filesystem;

constexpr int kFailed = 1;
constexpr int kMisused = 2;
[[maybe_unused]] constexpr rlim_t kMostMemory = 2ULL << 30U;  // bytes
constexpr rlim_t kMostTime = 60;                              // s of the processor

/// Damaged files may ask for any amount of both.
void limit_resources() {
  const rlimit time{kMostTime, kMostTime};
#if !defined(__SANITIZE_ADDRESS__)  // it uses terabytes of address space
  const rlimit memory{kMostMemory, kMostMemory};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  ::setrlimit(RLIMIT_CPU, &time);
}

std::string bytes_of(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw FormatError("file not found");
  return read_text(file);
}

int run(const std::string& command, const fs::path& file, const fs::path& folder) {
  limit_resources();
  try {
    const SceneFile scene = read_scene_file(bytes_of(file));
    if (command == "describe") {
      describe(scene, structure_of(scene), std::cout);
    } else {
      for (const std::string& line : write_scene(scene, file.stem().string(), folder)) std::cout << line << "\n";
    }
    return 0;
  } catch (const std::bad_alloc&) {
    std::cerr << "reading it takes more than 2 GB of memory: the file is too large or damaged\n";
    return kFailed;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return kFailed;
  }
}

}  // namespace
}  // namespace bubblesim::ttt

int main(int count, char** words) {
  const std::string command = count > 1 ? words[1] : "";
  if (command == "describe" && count == 3) return bubblesim::ttt::run(command, words[2], {});
  if (command == "convert" && count == 4) return bubblesim::ttt::run(command, words[2], words[3]);
  std::cerr << "usage: scene_converter describe FILE | scene_converter convert FILE FOLDER\n";
  return bubblesim::ttt::kMisused;
}
