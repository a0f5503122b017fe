// SPDX-License-Identifier: BSD-3-Clause
#include "peer_lines.hpp"

#include <console_bridge/console.h>
#include <ros/console.h>
#include <ros/console_backend.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>

namespace bubblesim {
namespace {

namespace backend = ros::console::backend;

class LineBudget {
 public:
  /// Whether one more line may be printed. Thread-safe.
  bool take() {
    constexpr int kLines = 10;
    constexpr std::chrono::minutes kPeriod(1);
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (printed_ == 0 || now - begin_ >= kPeriod) {
      if (left_out_ > 0) std::fprintf(stderr, "%d more lines about connections of peers were suppressed\n", left_out_);
      begin_ = now;
      printed_ = left_out_ = 0;
    }
    if (printed_ < kLines) {
      ++printed_;
      return true;
    }
    if (left_out_++ == 0) {
      std::fprintf(stderr, "suppressing more lines about connections of peers for one minute\n");
    }
    return false;
  }

 private:
  std::mutex mutex_;
  std::chrono::steady_clock::time_point begin_;
  int printed_ = 0;
  int left_out_ = 0;
};

// Never destroyed: roscpp's threads may log until the process ends.
LineBudget& budget() {
  static auto* const of_process = std::make_unique<LineBudget>().release();
  return *of_process;
}

/// The lines of roscpp's parser of headers, which does not log as roscpp does.
class HeaderLines : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char* file, int line) override {
    if (std::strstr(file, "header.cpp") != nullptr && !budget().take()) return;
    before_->log(text, level, file, line);
  }

 private:
  console_bridge::OutputHandler* const before_ = console_bridge::getOutputHandler();
};

decltype(backend::function_print) print_as_before = nullptr;

void print_within_budget(void* logger, ros::console::Level level, const char* text, const char* file,
                         const char* function, int line) {
  const bool is_of_roscpp = std::strstr(file, "/libros/") != nullptr;
  if (level >= ros::console::levels::Warn && is_of_roscpp && !budget().take()) return;
  print_as_before(logger, level, text, file, function, line);
}

}  // namespace

void limit_peer_lines() {
  if (print_as_before != nullptr) return;
  ros::console::initialize();
  print_as_before = backend::function_print;
  backend::function_print = print_within_budget;
  console_bridge::useOutputHandler(std::make_unique<HeaderLines>().release());
}

}  // namespace bubblesim
