// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/descriptor_watch.hpp"

#include <stdexcept>
#include <utility>

namespace bubblesim {

DescriptorWatch::DescriptorWatch(Runner& runner, int descriptor, std::function<bool()> serve)
    : runner_(runner), watched_(std::make_shared<WatchedDescriptor>(WatchedDescriptor{descriptor, std::move(serve)})) {
  runner_.add_descriptor(watched_);
}

DescriptorWatch::~DescriptorWatch() {
  if (!watched_) return;
  try {
    close();
  } catch (const std::logic_error&) {  // in another thread than the runner's
    runner_.call([&runner = runner_, watched = watched_] { runner.remove_descriptor(*watched); });
  }
}

void DescriptorWatch::close() {
  if (!watched_) return;  // the runner may be gone by now
  runner_.remove_descriptor(*watched_);
  watched_.reset();
}

}  // namespace bubblesim
