// SPDX-License-Identifier: BSD-3-Clause
// A value of any struct that lists its members, and knows which one it is.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "bubblesim/member_table.hpp"

namespace bubblesim {

/// Holds a struct of up to kInline bytes in itself, a larger one on the heap. A new value of the same struct is
/// assigned to the old one: it allocates nothing, and arrays keep their memory.
class AnyRecord {
 public:
  static constexpr std::size_t kInline = 128;

  AnyRecord() = default;
  template <class Struct, class = std::enable_if_t<HasMembers<Struct>::value>>
  AnyRecord(Struct value) {  // NOLINT: a description is one of a kind
    emplace_moved(Struct::members(), &value);
  }
  AnyRecord(const AnyRecord& other) { emplace_copy(other); }
  AnyRecord(AnyRecord&& other) noexcept { take(other); }
  AnyRecord& operator=(const AnyRecord& other);
  AnyRecord& operator=(AnyRecord&& other) noexcept;
  template <class Struct, class = std::enable_if_t<HasMembers<std::decay_t<Struct>>::value>>
  AnyRecord& operator=(Struct&& value) {
    using Held = std::decay_t<Struct>;
    if (Held* same = get_if<Held>()) {
      *same = std::forward<Struct>(value);
      return *this;
    }
    return *this = AnyRecord(Held(std::forward<Struct>(value)));
  }
  ~AnyRecord() { clear(); }

  /// The list of the members; null when nothing is held.
  const MemberTable* table() const { return table_; }
  const void* data() const { return data_; }
  void* data() { return data_; }

  template <class Struct>
  bool holds() const {
    return table_ == &Struct::members();
  }
  /// Null when it holds another struct.
  template <class Struct>
  const Struct* get_if() const {
    return holds<Struct>() ? static_cast<const Struct*>(data_) : nullptr;
  }
  template <class Struct>
  Struct* get_if() {
    return holds<Struct>() ? static_cast<Struct*>(data_) : nullptr;
  }
  /// Throws std::logic_error when it holds another struct.
  template <class Struct>
  const Struct& get() const {
    require(Struct::members());
    return *static_cast<const Struct*>(data_);
  }
  template <class Struct>
  Struct& get() {
    require(Struct::members());
    return *static_cast<Struct*>(data_);
  }

 private:
  void emplace_moved(const MemberTable& table, void* value);
  void emplace_copy(const AnyRecord& other);
  void take(AnyRecord& other) noexcept;
  void* place(const MemberTable& table);
  void clear() noexcept;
  void require(const MemberTable& table) const {
    if (table_ != &table) refuse(table);
  }
  [[noreturn]] void refuse(const MemberTable& table) const;

  const MemberTable* table_ = nullptr;
  void* data_ = nullptr;  // in inline_ or on the heap
  alignas(std::max_align_t) std::byte inline_[kInline];
};

}  // namespace bubblesim
