// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>
#include <vector>

#include "bubblesim/messages/registry.hpp"
#include "bubblesim/messages/translator.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {
namespace {

using namespace messages;

/// All types of both versions of ROS, as far as this build has them.
std::vector<const MessageType*> all_types() {
  std::vector<const MessageType*> types;
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    for (const std::string& name : message_names(version)) types.push_back(find_message(name, version));
  }
  return types;
}

WireView view_of(const WireBuffer& bytes) {
  WireView view(bytes.data(), bytes.size());
  view.begin(bytes.layout());
  return view;
}

std::string text_of(const WireBuffer& bytes) {
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace

void read_message(std::string_view data) {
  static const std::vector<const MessageType*> kTypes = all_types();
  if (data.size() < 2 || kTypes.empty()) return;
  const std::size_t number = static_cast<std::uint8_t>(data[0]) * 256U + static_cast<std::uint8_t>(data[1]);
  const MessageType& type = *kTypes[number % kTypes.size()];
  // In a buffer of its own, so that a sanitizer sees what lies before and after it.
  const std::vector<std::uint8_t> bytes(data.begin() + 2, data.end());
  WireView message(bytes.data(), bytes.size());
  message.begin(layout_of(type.version));
  try {
    const Translator same(type, type);
    const WireBuffer once = same.translate(message);
    const WireBuffer twice = same.translate(view_of(once));
    require(text_of(once) == text_of(twice), "a message that was written is read as the same");
  } catch (const WireError&) {
    return;
  }
}

}  // namespace bubblesim::fuzz
