// SPDX-License-Identifier: BSD-3-Clause
#include "scene/record_state.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace bubblesim {
namespace {

void transfer_members(StateArchive& archive, const MemberTable& table, void* record);

template <class Value>
void transfer_value(StateArchive& archive, void* value) {
  archive(*static_cast<Value*>(value));
}

void transfer_list(StateArchive& archive, const RecordList& list, void* value) {
  std::size_t size = list.size(value);
  if (list.resize != nullptr) {
    size = archive.count(size);
    list.resize(value, size);
  }
  for (std::size_t i = 0; i < size; ++i) transfer_members(archive, list.table(), const_cast<void*>(list.at(value, i)));
}

void transfer_member(StateArchive& archive, const Member& member, void* value) {
  switch (member.type) {
    case MemberType::kFlag:
      return transfer_value<bool>(archive, value);
    case MemberType::kInteger:
    case MemberType::kChoice:
      return archive.bytes(value, sizeof(std::int32_t));
    case MemberType::kNumber:
      return transfer_value<double>(archive, value);
    case MemberType::kText:
      return transfer_value<std::string>(archive, value);
    case MemberType::kTexts:
      return transfer_value<std::vector<std::string>>(archive, value);
    case MemberType::kVector:
      return transfer_value<Vector3>(archive, value);
    case MemberType::kRotation:
      return transfer_value<Quaternion>(archive, value);
    case MemberType::kBytes:
      return transfer_value<std::vector<std::uint8_t>>(archive, value);
    case MemberType::kIntegers:
      return transfer_value<std::vector<std::int32_t>>(archive, value);
    case MemberType::kFloats:
      return transfer_value<std::vector<float>>(archive, value);
    case MemberType::kNumbers:
      return transfer_value<std::vector<double>>(archive, value);
    case MemberType::kRecord:
    case MemberType::kRecords:
      return transfer_list(archive, member.records, value);
  }
}

void transfer_members(StateArchive& archive, const MemberTable& table, void* record) {
  for (const Member& member : table.members) {
    if (member.is_stored()) transfer_member(archive, member, member.set(record));
  }
}

}  // namespace

void transfer_record(StateArchive& archive, AnyRecord& record) {
  if (record.table() != nullptr) transfer_members(archive, *record.table(), record.data());
}

}  // namespace bubblesim
