// SPDX-License-Identifier: BSD-3-Clause
// Fields whose names differ between ROS 1 and ROS 2; tests/bindings checks the messages field by field.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bubblesim/messages/registry.hpp"
#include "camera_messages.hpp"

namespace bubblesim::reading_messages {
namespace {

using messages::ArrayKind;
using messages::FieldKind;
using messages::MessageType;

class Info final : public messages::FieldReader {
 public:
  void read(Fields& fields) const override {
    camera_info(fields, {}, {640, 480, 500, 319.5, 239.5, 0.1, {0.1, 0.2, 0.3, 0.4, 0.5}});
  }
};

std::vector<double> matrices(const std::vector<std::string>& names) {
  MessageType type;
  type.name = "bubblesim_test/CameraInfo_" + names[0];
  type.type_hash = names[0];
  for (const std::string& name : names) type.fields.push_back({name, FieldKind::kFloat64, ArrayKind::kVariable});
  messages::WireBuffer bytes;
  messages::encode(messages::add_message(type), Info(), bytes);
  messages::WireView view(bytes.data(), bytes.size());
  std::vector<double> values;
  while (view.left() > 0) {
    for (auto count = view.get<std::uint32_t>(); count > 0; --count) values.push_back(view.get<double>());
  }
  return values;
}

TEST(CameraInfo, HasTheNamesOfRos1AndOfRos2) {
  const std::vector<double> values = matrices({"D", "K", "R", "P"});
  EXPECT_EQ(values.size(), 5U + 9U + 9U + 12U);
  EXPECT_EQ(matrices({"d", "k", "r", "p"}), values);
}

}  // namespace
}  // namespace bubblesim::reading_messages
