// SPDX-License-Identifier: BSD-3-Clause
#include "ode_handles.hpp"

#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <string>

#include "bubblesim/error.hpp"

namespace bubblesim::ode {
namespace {

// ODE declares its handlers as C functions, but calls them from C++ code that exceptions pass through.
void throw_diverged(int number, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  throw Diverged("ODE error " + std::to_string(number) + ": " + text);
}

void print_message(int, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  std::fprintf(stderr, "warning: physics: %s\n", text);
}

}  // namespace

void prepare_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetErrorHandler(throw_diverged);
    dSetDebugHandler(throw_diverged);
    dSetMessageHandler(print_message);
  });
  thread_local const int allocated = dAllocateODEDataForThread(dAllocateMaskAll);
  static_cast<void>(allocated);
}

}  // namespace bubblesim::ode
