// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/any_record.hpp"

#include "bubblesim/error.hpp"

namespace bubblesim {
namespace {

bool fits(const RecordOperations& record) {
  return record.size <= AnyRecord::kInline && record.alignment <= alignof(std::max_align_t);
}

}  // namespace

AnyRecord& AnyRecord::operator=(const AnyRecord& other) {
  if (this == &other) return *this;
  if (table_ != nullptr && table_ == other.table_) {
    table_->operations.assign(data_, other.data_);
    return *this;
  }
  return *this = AnyRecord(other);
}

AnyRecord& AnyRecord::operator=(AnyRecord&& other) noexcept {
  if (this == &other) return *this;
  clear();
  take(other);
  return *this;
}

void AnyRecord::emplace_moved(const MemberTable& table, void* value) {
  void* to = place(table);
  table.operations.move(to, value);
  table_ = &table;
  data_ = to;
}

void AnyRecord::emplace_copy(const AnyRecord& other) {
  if (other.table_ == nullptr) return;
  void* to = place(*other.table_);
  try {
    other.table_->operations.copy(to, other.data_);
  } catch (...) {
    if (to != inline_) ::operator delete (to, std::align_val_t{other.table_->operations.alignment});
    throw;
  }
  table_ = other.table_;
  data_ = to;
}

/// Takes the value of another one, which is empty afterwards. This one is empty.
void AnyRecord::take(AnyRecord& other) noexcept {
  if (other.table_ == nullptr) return;
  table_ = other.table_;
  if (other.data_ != other.inline_) {
    data_ = std::exchange(other.data_, nullptr);
    other.table_ = nullptr;
    return;
  }
  data_ = inline_;
  table_->operations.move(data_, other.data_);
  other.clear();
}

void* AnyRecord::place(const MemberTable& table) {
  const RecordOperations& record = table.operations;
  return fits(record) ? inline_ : ::operator new (record.size, std::align_val_t{record.alignment});
}

void AnyRecord::clear() noexcept {
  if (table_ == nullptr) return;
  table_->operations.destroy(data_);
  if (data_ != inline_) ::operator delete (data_, std::align_val_t{table_->operations.alignment});
  table_ = nullptr;
  data_ = nullptr;
}

void AnyRecord::refuse(const MemberTable& table) const {
  throw std::logic_error("this is " + with_article(table_ == nullptr ? "record without a value" : table_->name) +
                         ", not " + with_article(table.name));
}

}  // namespace bubblesim
