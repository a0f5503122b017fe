// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/file_watch.hpp"

#include <stdexcept>
#include <utility>

namespace bubblesim {

FileWatch::FileWatch(Runner& runner, int descriptor, std::function<bool()> serve)
    : runner_(runner), file_(std::make_shared<WatchedFile>(WatchedFile{descriptor, std::move(serve)})) {
  runner_.add_file(file_);
}

FileWatch::~FileWatch() {
  if (!file_) return;
  try {
    close();
  } catch (const std::logic_error&) {  // in another thread than the runner's
    runner_.call([&runner = runner_, file = file_] { runner.remove_file(*file); });
  }
}

void FileWatch::close() {
  if (!file_) return;  // the runner may be gone by now
  runner_.remove_file(*file_);
  file_.reset();
}

}  // namespace bubblesim
