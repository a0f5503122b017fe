// SPDX-License-Identifier: BSD-3-Clause
#include "peer_lines.hpp"

#include <ros/console.h>
#include <ros/console_backend.h>
#include <xmlrpcpp/XmlRpcUtil.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>

namespace bubblesim {
namespace {

namespace backend = ros::console::backend;

class LineBudget {
 public:
  explicit LineBudget(const char* about) : about_(about) {}

  /// Whether one more line may be printed. Thread-safe.
  bool take() {
    constexpr int kLines = 10;
    constexpr std::chrono::minutes kPeriod(1);
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (printed_ == 0 || now - begin_ >= kPeriod) {
      if (left_out_ > 0) std::fprintf(stderr, "%d more lines about %s were suppressed\n", left_out_, about_);
      begin_ = now;
      printed_ = left_out_ = 0;
    }
    if (printed_ < kLines) {
      ++printed_;
      return true;
    }
    if (left_out_++ == 0) std::fprintf(stderr, "suppressing more lines about %s for one minute\n", about_);
    return false;
  }

 private:
  const char* about_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point begin_;
  int printed_ = 0;
  int left_out_ = 0;
};

/// The lines of xmlrpcpp, which prints to stderr without log levels.
class XmlRpcLines : public XmlRpc::XmlRpcErrorHandler {
 public:
  void error(const char* msg) override {
    if (budget_.take()) before_->error(msg);
  }

 private:
  XmlRpc::XmlRpcErrorHandler* const before_ = getErrorHandler();
  LineBudget budget_{"XML-RPC connections"};
};

decltype(backend::function_print) print_as_before = nullptr;

void print_within_budget(void* logger, ros::console::Level level, const char* text, const char* file,
                         const char* function, int line) {
  // Never destroyed: roscpp's threads may log until the process ends.
  static auto* const budget = std::make_unique<LineBudget>("connections of peers").release();
  const bool is_of_roscpp = std::strstr(file, "/libros/") != nullptr || std::strstr(file, "header.cpp") != nullptr;
  if (level >= ros::console::levels::Warn && is_of_roscpp && !budget->take()) return;
  print_as_before(logger, level, text, file, function, line);
}

}  // namespace

void limit_peer_lines() {
  if (print_as_before != nullptr) return;
  ros::console::initialize();
  print_as_before = backend::function_print;
  backend::function_print = print_within_budget;
  XmlRpc::XmlRpcErrorHandler::setErrorHandler(std::make_unique<XmlRpcLines>().release());
}

}  // namespace bubblesim
