// SPDX-License-Identifier: BSD-3-Clause
#include "run/inbox.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#include "bubblesim/error.hpp"

namespace bubblesim {

Inbox::Inbox() : signal_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (signal_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Inbox::~Inbox() { ::close(signal_); }

void Inbox::put(Command command) {
  {
    const std::lock_guard lock(mutex_);
    if (!closed_) {
      commands_.push_back(std::move(command));
      if (waits_for_commands_) signal();
      return;
    }
  }
  command.refuse(has_ended());
}

void Inbox::open() {
  const std::lock_guard lock(mutex_);
  closed_ = false;
}

void Inbox::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  for (const Command& command : take()) command.refuse(has_ended());
}

std::exception_ptr Inbox::has_ended() { return std::make_exception_ptr(NotCarriedOut("the simulation has ended")); }

std::vector<Command> Inbox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

bool Inbox::empty() const {
  const std::lock_guard lock(mutex_);
  return commands_.empty();
}

bool Inbox::has(Command::Kind kind) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(commands_.begin(), commands_.end(), [kind](const Command& each) { return each.kind == kind; });
}

void Inbox::wake() {
  const std::lock_guard lock(mutex_);
  woken_ = true;
  if (waits_for_wake_) signal();
}

/// Called with the mutex. One signal is enough for a wait.
void Inbox::signal() {
  eventfd_write(signal_, 1);  // cannot block or fail
  waits_for_commands_ = waits_for_wake_ = false;
}

Inbox::Wait::Wait(Inbox& inbox, WaitFor what) : inbox_(inbox), for_input_(what == WaitFor::kInput) {
  const std::lock_guard lock(inbox_.mutex_);
  if (!inbox_.commands_.empty() || (for_input_ && inbox_.woken_)) return;
  inbox_.waits_for_commands_ = true;
  inbox_.waits_for_wake_ = for_input_;
}

Inbox::Wait::~Wait() {
  const std::lock_guard lock(inbox_.mutex_);
  eventfd_t count = 0;
  if (!inbox_.waits_for_commands_) eventfd_read(inbox_.signal_, &count);
  inbox_.waits_for_commands_ = inbox_.waits_for_wake_ = false;
  if (for_input_) inbox_.woken_ = false;
}

bool Inbox::Wait::is_over() const {
  const std::lock_guard lock(inbox_.mutex_);
  return !inbox_.waits_for_commands_;
}

}  // namespace bubblesim
