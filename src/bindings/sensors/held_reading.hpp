// SPDX-License-Identifier: BSD-3-Clause
// Readings of one kind as parameters: they keep the reading unchanged, also after Python has dropped it.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "sensors/record_class.hpp"

namespace bubblesim::bindings {

template <class Kind>
struct Held {
  std::shared_ptr<const Reading> reading;
  const Kind* measured = nullptr;

  const Kind& operator*() const { return *measured; }
  const Kind* operator->() const { return measured; }
};

}  // namespace bubblesim::bindings

namespace pybind11::detail {

template <class Kind>
struct type_caster<bubblesim::bindings::Held<Kind>> {
  PYBIND11_TYPE_CASTER(bubblesim::bindings::Held<Kind>, const_name("reading"));

  bool load(handle source, bool) {
    if (!bubblesim::bindings::is_record_of(source, Kind::members())) return false;
    value = {bubblesim::bindings::reading_of(source), &bubblesim::bindings::record_of<Kind>(source)};
    return true;
  }
};

}  // namespace pybind11::detail
