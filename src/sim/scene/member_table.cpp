// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/member_table.hpp"

#include <cstring>

namespace bubblesim {

Member Member::with_choices(std::vector<std::string> names) && {
  choices = std::move(names);
  return std::move(*this);
}

Member Member::with_limits(double lowest, double highest, std::string in_words) && {
  least = lowest;
  most = highest;
  limits = std::move(in_words);
  return std::move(*this);
}

Member Member::with_title(std::string words) && {
  title = std::move(words);
  return std::move(*this);
}

Member Member::with_quantity(std::string quantity_name) && {
  quantity = std::move(quantity_name);
  return std::move(*this);
}

Member Member::or_none() && {
  none_when_empty = true;
  return std::move(*this);
}

Member Member::unlisted() && {
  listed = false;
  return std::move(*this);
}

const std::string& choice_of(const Member& member, const void* record) {
  std::int32_t number = 0;
  std::memcpy(&number, member.get(record), sizeof number);
  return member.choices.at(static_cast<std::size_t>(number));
}

const Member* MemberTable::find(const std::string& member_name) const {
  for (const Member& each : members) {
    if (each.name == member_name) return &each;
  }
  return nullptr;
}

}  // namespace bubblesim
