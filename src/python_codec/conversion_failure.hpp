// SPDX-License-Identifier: BSD-3-Clause
// Why and where in a message a value could not be converted, and what a conversion lost.
#pragma once

#include <Python.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bubblesim::bindings {

/// A float in an integer field.
struct Truncation {
  std::string field;  ///< path in the message, without the indices of arrays
  double value = 0;   ///< before it was truncated toward zero; the first one of an array
};

/// Largest loss of a float in an integer field without a report, such as 0.15 * 10^9, which is not quite whole.
constexpr double kUnnoticedTruncation = 1e-3;

/// Filled from the inside out while a failed conversion returns through its fields: successful conversions spend
/// nothing on paths. The functions that return a bool return false, for use in return statements.
class ConversionFailure {
 public:
  bool set(std::string reason);
  /// "expected <expected>, found <found>".
  bool expected(std::string_view expected, PyObject* found);
  bool inside(std::string_view field);
  bool inside(std::size_t index);

  /// Records a truncation in the current field, once for all elements of an array of numbers.
  void truncated(double value);
  std::size_t truncation_count() const { return truncations_.size(); }
  /// Puts the truncations from `first` on into this field.
  void truncated_inside(std::size_t first, std::string_view field);
  /// Of the truncations from `first` on, keeps one per field, for the elements of an array.
  void unite_truncations(std::size_t first);
  std::vector<Truncation> take_truncations() { return std::move(truncations_); }

  /// Sets MessageError, unless a Python exception of another origin (KeyboardInterrupt, MemoryError) is set.
  void raise(std::string_view type_name) const;

 private:
  std::string path_;
  std::string reason_;
  std::vector<Truncation> truncations_;
};

/// A value for error messages: "str 'abc'", "list of 3", "float 1.5".
std::string describe(PyObject* value);

/// Clears a Python exception that only means "wrong type or value", which gets a better text. Returns false and keeps
/// any other exception.
bool clear_conversion_error();

}  // namespace bubblesim::bindings
