// SPDX-License-Identifier: BSD-3-Clause
// Why and where inside a message a value could not be converted, and what was lost where it could.
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

/// What a float may lose in an integer field without a word, such as 0.15 * 10^9 that is not quite whole.
constexpr double kUnnoticedTruncation = 1e-3;

/// Filled from the inside out while a failed conversion returns through the fields that it was in: nothing is spent on
/// paths as long as all goes well. The functions that return a bool return false, so that they can be returned.
class ConversionFailure {
 public:
  bool set(std::string reason);
  /// "expected <expected>, found <found>".
  bool expected(std::string_view expected, PyObject* found);
  bool inside(std::string_view field);
  bool inside(std::size_t index);

  /// Notes a truncation in the field that is being converted, once for all elements of an array of numbers.
  void truncated(double value);
  std::size_t truncation_count() const { return truncations_.size(); }
  /// The truncations from `first` on were in this field.
  void truncated_inside(std::size_t first, std::string_view field);
  /// Of the truncations from `first` on, keeps one of each field: those of an array's elements.
  void unite_truncations(std::size_t first);
  std::vector<Truncation> take_truncations() { return std::move(truncations_); }

  /// Sets MessageError, unless a Python exception of another origin (KeyboardInterrupt, MemoryError) is set.
  void raise(std::string_view type_name) const;

 private:
  std::string path_;
  std::string reason_;
  std::vector<Truncation> truncations_;
};

/// A value as error texts show it: "str 'abc'", "list of 3", "float 1.5".
std::string describe(PyObject* value);

/// Clears a Python exception that only says "wrong type or value", for which there will be a better text. Returns false
/// and keeps it when it says anything else.
bool clear_conversion_error();

}  // namespace bubblesim::bindings
