// SPDX-License-Identifier: BSD-3-Clause
#include "physics/ode/ode_handles.hpp"

#include <dlfcn.h>

#include <cstdarg>
#include <cstdint>
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

thread_local bool warned = false;

// ODE reports here that its exact solver found no solution, each time.
void note_warning(int, const char*, va_list) { warned = true; }

thread_local std::uint32_t seed = 0;

/// Whether ODE's solvers call dRand() below.
bool uses_own_random() {
  const std::uint32_t before = seed;
  dRandInt(2);
  return std::exchange(seed, before) != before;
}

}  // namespace
}  // namespace bubblesim::ode

// ODE has one random state for all threads. The linker replaces its functions by these, with one for each thread.
unsigned long dRand() { return bubblesim::ode::seed = 1664525U * bubblesim::ode::seed + 1013904223U; }
unsigned long dRandGetSeed() { return bubblesim::ode::seed; }
void dRandSetSeed(unsigned long value) { bubblesim::ode::seed = static_cast<std::uint32_t>(value); }

namespace bubblesim::ode {

void prepare_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetErrorHandler(throw_diverged);
    dSetDebugHandler(throw_diverged);
    dSetMessageHandler(note_warning);
  });
  thread_local const int allocated = dAllocateODEDataForThread(dAllocateMaskAll);
  static_cast<void>(allocated);
}

void step_iteratively(dWorldID world, double step, unsigned long& random) {
  static const bool own = uses_own_random();
  if (own) {
    const std::uint32_t others = std::exchange(seed, static_cast<std::uint32_t>(random));
    dWorldQuickStep(world, step);
    random = std::exchange(seed, others);
    return;
  }
  // Another library loaded ODE before, with its one random state for all threads.
  static std::mutex mutex;
  static const auto get_seed = reinterpret_cast<unsigned long (*)()>(dlsym(RTLD_NEXT, "dRandGetSeed"));
  static const auto set_seed = reinterpret_cast<void (*)(unsigned long)>(dlsym(RTLD_NEXT, "dRandSetSeed"));
  const std::lock_guard lock(mutex);
  const unsigned long others = get_seed();
  set_seed(random);
  dWorldQuickStep(world, step);
  random = get_seed();
  set_seed(others);
}

bool solver_warned() { return std::exchange(warned, false); }

}  // namespace bubblesim::ode
