// SPDX-License-Identifier: BSD-3-Clause
#include "messages/message_lookup.hpp"

#include <pybind11/pybind11.h>

#include <vector>

#include "bubblesim/messages/registry.hpp"
#include "message_codec.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
using messages::MessageType;
using messages::RosVersion;
using messages::ServiceType;

/// Makes python/bubblesim/messages/runtime.py add the type from its definition on this machine. Does nothing if the
/// parser of definitions is not installed; raises MessageError if it fails.
void add_from_definition(const char* function, const std::string& name, RosVersion version) {
  try {
    py::module_::import("bubblesim.messages.runtime").attr(function)(name, version);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ImportError)) throw;
  }
}

[[noreturn]] void throw_unknown(const std::string& what, const std::string& name, const std::string& list,
                                const std::vector<std::string>& similar) {
  std::string hint;
  for (const std::string& candidate : similar) hint += (hint.empty() ? "" : " or ") + candidate;
  if (!hint.empty()) hint = "; did you mean " + hint + "?";
  if (hint.empty()) hint = "; to add it, write its line into " + list + " and run 'catkin build'";
  const std::string text = name + " is not among the " + what + " types of this build" + hint;
  PyErr_SetString(message_error(), text.c_str());
  throw py::error_already_set();
}

}  // namespace

const MessageType& listed_message(const std::string& name, RosVersion version) {
  if (const MessageType* type = messages::find_message(name, version)) return *type;
  add_from_definition("add_message", name, version);
  if (const MessageType* type = messages::find_message(name, version)) return *type;
  throw_unknown("message", name, "meta/messages.txt", messages::similar_message_names(name, version));
}

const ServiceType& listed_service(const std::string& name, RosVersion version) {
  if (const ServiceType* type = messages::find_service(name, version)) return *type;
  add_from_definition("add_service", name, version);
  if (const ServiceType* type = messages::find_service(name, version)) return *type;
  throw_unknown("service", name, "meta/services.txt", messages::similar_service_names(name, version));
}

}  // namespace bubblesim::bindings
