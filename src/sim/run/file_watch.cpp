// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/file_watch.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

namespace bubblesim {

struct FileWatch::State {
  State(int watched_, std::function<bool()> serve_)
      : watched(watched_), wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), serve(std::move(serve_)) {
    if (wake < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  }
  ~State() { ::close(wake); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  /// Returns false when it is to end.
  bool wait_until_readable() const {
    std::array<pollfd, 2> files{{{watched, POLLIN, 0}, {wake, POLLIN, 0}}};
    while (poll(files.data(), files.size(), -1) < 0) {
      if (errno != EINTR) return false;
    }
    return !ended && (files[0].revents & POLLNVAL) == 0;
  }

  const int watched;
  const int wake;
  const std::function<bool()> serve;
  std::atomic<bool> ended{false};
};

namespace {

constexpr std::chrono::milliseconds kBetweenLooks{20};  // at the end, while a call is pending

}  // namespace

FileWatch::FileWatch(Runner& runner, int descriptor, std::function<bool()> serve)
    : state_(std::make_shared<State>(descriptor, std::move(serve))) {
  thread_ = std::thread([&runner, state = state_] {
    bool more = true;  // perhaps it was readable before
    while (more || state->wait_until_readable()) {
      std::future<bool> done = runner.call([state] { return !state->ended && state->serve(); });
      while (done.wait_for(kBetweenLooks) != std::future_status::ready) {
        if (state->ended) return;
      }
      try {
        more = done.get();
      } catch (const std::exception&) {
        return;  // the run has ended, or the function cannot serve
      }
    }
  });
}

FileWatch::~FileWatch() { close(); }

void FileWatch::close() {
  if (!thread_.joinable()) return;
  state_->ended = true;
  const std::uint64_t one = 1;
  static_cast<void>(write(state_->wake, &one, sizeof one));  // cannot block or fail: it is written once
  thread_.join();
}

}  // namespace bubblesim
