// SPDX-License-Identifier: BSD-3-Clause
#include "conversion_failure.hpp"

#include <algorithm>

#include "message_walk.hpp"
#include "python_ref.hpp"

namespace bubblesim::bindings {
namespace {

constexpr Py_ssize_t kShownLetters = 40;

/// repr() of a value, or empty if that fails.
std::string repr(PyObject* value) {
  const Ref text = Ref::steal(PyObject_ASCII(value));
  const char* letters = text ? PyUnicode_AsUTF8(text.get()) : nullptr;
  if (letters == nullptr) {
    PyErr_Clear();
    return {};
  }
  const std::string shown(letters);
  return shown.size() > 2 * kShownLetters ? shown.substr(0, 2 * kShownLetters) + "..." : shown;
}

}  // namespace

std::string describe(PyObject* value) {
  if (value == Py_None) return "None";
  std::string type = Py_TYPE(value)->tp_name;
  if (PyUnicode_Check(value)) {
    if (PyUnicode_GetLength(value) <= kShownLetters) return type + " " + repr(value);
    const Ref start = Ref::steal(PyUnicode_Substring(value, 0, kShownLetters));
    return type + " " + repr(start.get()) + "...";
  }
  if (PyNumber_Check(value) && !PySequence_Check(value)) return type + " " + repr(value);
  if (PyList_Check(value) || PyTuple_Check(value) || PyBytes_Check(value) || PyByteArray_Check(value)) {
    return type + " of " + std::to_string(Py_SIZE(value));
  }
  return type;
}

bool clear_conversion_error() {
  const bool ours = PyErr_ExceptionMatches(PyExc_TypeError) != 0 || PyErr_ExceptionMatches(PyExc_ValueError) != 0 ||
                    PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
  if (ours) PyErr_Clear();
  return ours;
}

bool ConversionFailure::set(std::string reason) {
  reason_ = std::move(reason);
  return false;
}

bool ConversionFailure::expected(std::string_view expected, PyObject* found) {
  return set("expected " + std::string(expected) + ", found " + describe(found));
}

bool ConversionFailure::inside(std::string_view field) {
  const bool joins = !path_.empty() && path_.front() != '[';
  path_ = std::string(field) + (joins ? "." : "") + path_;
  return false;
}

bool ConversionFailure::inside(std::size_t index) {
  const bool joins = !path_.empty() && path_.front() != '[';
  path_ = "[" + std::to_string(index) + "]" + (joins ? "." : "") + path_;
  return false;
}

void ConversionFailure::truncated(double value) {
  if (truncations_.empty() || !truncations_.back().field.empty()) truncations_.push_back({{}, value});
}

void ConversionFailure::truncated_inside(std::size_t first, std::string_view field) {
  for (std::size_t i = first; i < truncations_.size(); ++i) {
    std::string& path = truncations_[i].field;
    path = std::string(field) + (path.empty() ? "" : ".") + path;
  }
}

void ConversionFailure::unite_truncations(std::size_t first) {
  std::vector<Truncation> kept(truncations_.begin(), truncations_.begin() + static_cast<std::ptrdiff_t>(first));
  for (std::size_t i = first; i < truncations_.size(); ++i) {
    const auto same = [&](const Truncation& earlier) { return earlier.field == truncations_[i].field; };
    const auto begin = kept.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::none_of(begin, kept.end(), same)) kept.push_back(truncations_[i]);
  }
  truncations_ = std::move(kept);
}

void ConversionFailure::raise(std::string_view type_name) const {
  if (PyErr_Occurred() != nullptr) return;
  const std::string text = std::string(type_name) + ": " + (path_.empty() ? "" : path_ + ": ") + reason_;
  PyErr_SetString(message_error(), text.c_str());
}

}  // namespace bubblesim::bindings
