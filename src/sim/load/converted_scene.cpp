// SPDX-License-Identifier: BSD-3-Clause
#include "load/converted_scene.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "files/file_text.hpp"
#include "files/library_folder.hpp"
#include "load/limited_program.hpp"
#include "load/ttt/write_scene.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kTimeLimit{60};

/// A folder of the user's own: others could put scenes with their scripts into one in /tmp.
fs::path cache_folder() {
  const char* given = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const bool has_home = home != nullptr && *home != 0;
  if (given != nullptr && *given == '/') return fs::path(given) / "bubblesim" / "converted";
  if (has_home) return fs::path(home) / ".cache" / "bubblesim" / "converted";
  throw std::runtime_error("there is no folder for the converted scene: set HOME or XDG_CACHE_HOME");
}

/// Of the file and of the program that converts it: another one may write something else.
std::string key_of(const fs::path& name, const std::string& content, const fs::path& program) {
  std::array<char, 64> text{};
  const auto changed = fs::last_write_time(program).time_since_epoch().count();
  Fnv1a hash;
  hash.add(std::string_view(name.native()));
  hash.add(std::string_view(content));
  std::snprintf(text.data(), text.size(), "%016llx-%zu-%llx", static_cast<unsigned long long>(hash.value()),
                content.size(), static_cast<unsigned long long>(changed));
  return text.data();
}

/// An own empty folder beside the others, removed unless it is kept.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& parent) {
    fs::create_directories(parent);
    fs::permissions(parent, fs::perms::owner_all);
    std::string name = (parent / "new-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw std::runtime_error("cannot create a folder in " + parent.string() + ": " + std::strerror(errno));
    }
    path_ = name;
  }
  ~NewFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const fs::path& path() const { return path_; }
  /// Another process may have been faster: then its folder remains.
  void move_to(const fs::path& target) {
    std::error_code error;
    fs::rename(path_, target, error);
    if (!error) path_.clear();
  }

 private:
  fs::path path_;
};

/// Converts the copy of `file` that is in the folder: the file itself may change meanwhile.
void run_converter(const fs::path& program, const fs::path& file, const fs::path& folder) {
  const auto fail = [&file](const std::string& message) { throw SceneError({{file.string(), 0, "", message}}); };
  const ProgramResult result =
      run_limited({program.string(), "convert", (folder / file.filename()).string(), folder.string()}, kTimeLimit);
  if (!result.in_time) fail("its conversion did not end within 60 s and was stopped: the file is too large or damaged");
  if (WIFSIGNALED(result.status)) {
    fail("its conversion was ended by signal " + std::string(::sigabbrev_np(WTERMSIG(result.status))) +
         ": the file is damaged");
  }
  if (WEXITSTATUS(result.status) != 0) fail(result.errors.substr(0, result.errors.find('\n')));
}

/// Compares the whole file: keys of two files can be made equal on purpose, and scenes have programs.
bool is_conversion_of(const fs::path& folder, const fs::path& name, const std::string& content) {
  return fs::is_regular_file(folder / ttt::kSceneFile) && fs::is_regular_file(folder / name) &&
         read_text(folder / name) == content;
}

/// Bytes of the files in a folder.
std::uintmax_t size_of(const fs::path& folder) {
  std::uintmax_t size = 0;
  std::error_code error;
  for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder, error)) {
    if (file.is_regular_file(error)) size += file.file_size(error);
  }
  return size;
}

/// Removes the conversions that were used longest ago when all take more than a gigabyte. Other processes may do the
/// same: what is gone already is no error.
void remove_old(const fs::path& all, const fs::path& kept) {
  constexpr std::uintmax_t kMost = 1'000'000'000;
  struct Known {
    fs::file_time_type used;
    fs::path folder;
    std::uintmax_t size;
  };
  std::error_code error;
  std::vector<Known> known;
  std::uintmax_t total = 0;
  for (const fs::directory_entry& folder : fs::directory_iterator(all, error)) {
    known.push_back({folder.last_write_time(error), folder.path(), size_of(folder.path())});
    total += known.back().size;
  }
  std::sort(known.begin(), known.end(), [](const Known& a, const Known& b) { return a.used < b.used; });
  for (const Known& each : known) {
    if (total <= kMost) return;
    if (each.folder == kept) continue;
    fs::remove_all(each.folder, error);
    total -= each.size;
  }
}

}  // namespace

bool is_foreign_scene(const fs::path& file) { return file.extension() == ".ttt" || file.extension() == ".ttm"; }

ConvertedScene convert_scene(const fs::path& file) {
  const fs::path program = library_folder() / "bubblesim" / "scene_converter";
  const fs::path name = file.filename();
  const std::string content = read_text(file);
  const fs::path folder = cache_folder() / key_of(name, content, program);
  if (!is_conversion_of(folder, name, content)) {
    NewFolder made(folder.parent_path());
    write_file(made.path() / name, content);
    run_converter(program, file, made.path());
    fs::remove_all(folder);
    made.move_to(folder);
    remove_old(folder.parent_path(), folder);
  }
  std::error_code ignored;
  fs::last_write_time(folder, fs::file_time_type::clock::now(), ignored);  // used now
  return {folder / ttt::kSceneFile, lines_of(read_text(folder / ttt::kLeftOutFile))};
}

}  // namespace bubblesim
