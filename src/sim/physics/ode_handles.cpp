// SPDX-License-Identifier: BSD-3-Clause
#include "physics/ode_handles.hpp"

#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"

namespace bubblesim::ode {
namespace {

// ODE declares its handlers as C functions, and calls them from C++ code that exceptions can pass through.
void throw_diverged(int number, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  throw Diverged("ODE error " + std::to_string(number) + ": " + text);
}

thread_local bool complained = false;

// ODE reports here that its exact solver found no solution, each time.
void note_complaint(int, const char*, va_list) { complained = true; }

}  // namespace

void prepare_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetErrorHandler(throw_diverged);
    dSetDebugHandler(throw_diverged);
    dSetMessageHandler(note_complaint);
  });
  thread_local const int allocated = dAllocateODEDataForThread(dAllocateMaskAll);
  static_cast<void>(allocated);
}

bool solver_warned() { return std::exchange(complained, false); }

}  // namespace bubblesim::ode
