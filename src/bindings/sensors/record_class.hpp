// SPDX-License-Identifier: BSD-3-Clause
// The Python classes of readings and of the structs in them: a property for each listed member. They are made from the
// lists of members, also those of kinds that are added while Python runs.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "bubblesim/sensor.hpp"

namespace bubblesim::bindings {

/// The classes of the readings of all kinds of sensors. Call it before the other functions.
void bind_record_classes(pybind11::module_& core);

/// The class of a struct, which is an attribute of bubblesim._core as well. Its attribute `_fields` names the
/// properties that are members of the struct, without those that are computed.
pybind11::object class_of(const MemberTable& table);

/// A reading as an object of its class. It and its arrays keep the reading unchanged while they exist.
pybind11::object to_python(std::shared_ptr<const Reading> reading);

bool is_record_of(const pybind11::handle& object, const MemberTable& table);

/// The reading that an object of one of these classes belongs to.
std::shared_ptr<const Reading> reading_of(const pybind11::handle& object);

/// The struct of an object of its class. Throws TypeError for another object.
const void* record_of(const pybind11::handle& object, const MemberTable& table);

template <class Struct>
const Struct& record_of(const pybind11::handle& object) {
  return *static_cast<const Struct*>(record_of(object, Struct::members()));
}

}  // namespace bubblesim::bindings
