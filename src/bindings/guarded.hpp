// SPDX-License-Identifier: BSD-3-Clause
// Bound functions that lock their simulation while they run, so that Python threads may call them during step().
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

#include "bubblesim/access_lock.hpp"
#include "bubblesim/simulation.hpp"
#include "object_view.hpp"

namespace bubblesim::bindings {

inline AccessLock& lock_of(const World& world) { return world.access(); }
inline AccessLock& lock_of(const Simulation& simulation) { return simulation.world().access(); }
inline AccessLock& lock_of(const ObjectView& view) { return view.world().access(); }
inline AccessLock& lock_of(const pybind11::object& simulation) { return lock_of(simulation.cast<Simulation&>()); }

/// AccessLock::Hold for a thread that holds the GIL. Releases the GIL while it waits, because the thread that has the
/// lock may need it.
class HoldWithGil {
 public:
  explicit HoldWithGil(AccessLock& lock) : lock_(lock.is_mine() ? nullptr : &lock) {
    if (lock_ == nullptr || lock_->try_take()) return;
    const pybind11::gil_scoped_release others_may_run;
    lock_->take();
  }
  ~HoldWithGil() {
    if (lock_ != nullptr) lock_->release();
  }
  HoldWithGil(const HoldWithGil&) = delete;
  HoldWithGil& operator=(const HoldWithGil&) = delete;

 private:
  AccessLock* lock_;
};

/// Wraps a function whose first parameter refers to a simulation so that it locks the simulation.
template <class Function, class Return, class First, class... Rest>
auto holding(Function function, Return (*)(First, Rest...)) {
  return [function](First first, Rest... rest) -> Return {
    const HoldWithGil hold(lock_of(first));
    return function(std::forward<First>(first), std::forward<Rest>(rest)...);
  };
}

template <class Function>
auto holding(Function function) {
  return holding(function, static_cast<pybind11::detail::function_signature_t<Function>*>(nullptr));
}

template <class Class, class Return, class... Rest>
auto holding(Return (Class::*method)(Rest...)) {
  return holding([method](Class& self, Rest... rest) -> Return { return (self.*method)(std::forward<Rest>(rest)...); });
}

template <class Class, class Return, class... Rest>
auto holding(Return (Class::*method)(Rest...) const) {
  return holding(
      [method](const Class& self, Rest... rest) -> Return { return (self.*method)(std::forward<Rest>(rest)...); });
}

/// Adds functions to a pybind11 class or module, each of which locks its simulation.
template <class Scope>
class Guarded {
 public:
  explicit Guarded(Scope& scope) : scope_(scope) {}

  template <class Function, class... Extra>
  Guarded& def(const char* name, Function function, const Extra&... extra) {
    scope_.def(name, holding(function), extra...);
    return *this;
  }
  template <class Getter, class... Extra>
  Guarded& def_property_readonly(const char* name, Getter getter, const Extra&... extra) {
    scope_.def_property_readonly(name, holding(getter), extra...);
    return *this;
  }
  /// A property whose value must not outlive its object: pybind11 ignores keep_alive beside a getter.
  template <class Getter>
  Guarded& def_part(const char* name, Getter getter, const char* description) {
    scope_.def_property_readonly(name, pybind11::cpp_function(holding(getter), pybind11::keep_alive<0, 1>()),
                                 description);
    return *this;
  }
  template <class Getter, class Setter, class... Extra>
  Guarded& def_property(const char* name, Getter getter, Setter setter, const Extra&... extra) {
    scope_.def_property(name, holding(getter), holding(setter), extra...);
    return *this;
  }

 private:
  Scope& scope_;
};

}  // namespace bubblesim::bindings
