// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "bubblesim/messages/registry.hpp"

namespace bubblesim::messages {
namespace {

const Constant* find_constant(const MessageType& type, const std::string& name) {
  for (const Constant& constant : type.constants) {
    if (constant.name == name) return &constant;
  }
  return nullptr;
}

TEST(Registry, FindsTypesByBothSpellings) {
  ASSERT_NE(find_message("geometry_msgs/Twist"), nullptr);
  EXPECT_EQ(find_message("geometry_msgs/Twist"), find_message("geometry_msgs/msg/Twist"));
}

TEST(Registry, DoesNotKnowUnlistedTypes) {
  EXPECT_EQ(find_message("geometry_msgs/Twixt"), nullptr);
  EXPECT_EQ(find_message(""), nullptr);
  EXPECT_EQ(find_message("/"), nullptr);
  EXPECT_EQ(find_message("std_srvs/SetBool"), nullptr);
  EXPECT_EQ(find_service("geometry_msgs/Twist"), nullptr);
}

TEST(Registry, NestedFieldsPointToTheirTypes) {
  const MessageType* twist = find_message("geometry_msgs/Twist");
  ASSERT_NE(twist, nullptr);
  ASSERT_EQ(twist->fields.size(), 2U);
  EXPECT_EQ(twist->fields[0].name, "linear");
  EXPECT_EQ(twist->fields[0].message, find_message("geometry_msgs/Vector3"));
}

TEST(Registry, ArraysCarryTheirLength) {
  const MessageType* pose = find_message("geometry_msgs/PoseWithCovariance");
  ASSERT_NE(pose, nullptr);
  EXPECT_EQ(pose->fields[1].array, ArrayKind::kFixed);
  EXPECT_EQ(pose->fields[1].fixed_length, 36U);
  EXPECT_EQ(pose->fields[1].kind, FieldKind::kFloat64);
}

TEST(Registry, ServicesHaveTwoHalves) {
  const ServiceType* service = find_service("std_srvs/srv/SetBool");
  ASSERT_NE(service, nullptr);
  EXPECT_EQ(service->type_hash, "09fb03525b03e7ea1fd3992bafd87e16");
  EXPECT_EQ(service->request, find_message("std_srvs/SetBoolRequest"));
  EXPECT_EQ(service->response->fields.size(), 2U);
}

TEST(Registry, KnowsWhichTypesStartWithAHeader) {
  EXPECT_TRUE(find_message("sensor_msgs/Image")->has_header);
  EXPECT_FALSE(find_message("geometry_msgs/Twist")->has_header);
  EXPECT_FALSE(find_message("std_msgs/Header")->has_header);
}

TEST(Registry, ConstantsKeepTheirKind) {
  const MessageType* status = find_message("diagnostic_msgs/DiagnosticStatus");
  const MessageType* fix = find_message("sensor_msgs/NavSatStatus");
  ASSERT_NE(find_constant(*status, "STALE"), nullptr);
  EXPECT_EQ(std::get<std::int64_t>(find_constant(*status, "STALE")->value), 3);
  EXPECT_EQ(std::get<std::int64_t>(find_constant(*fix, "STATUS_NO_FIX")->value), -1);
}

TEST(Registry, NamesAreSortedAndIncludeNestedTypesButNoHalves) {
  const std::vector<std::string> names = message_names();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_TRUE(std::binary_search(names.begin(), names.end(), "std_msgs/Header"));
  EXPECT_FALSE(std::binary_search(names.begin(), names.end(), "std_srvs/SetBoolRequest"));
}

TEST(Registry, SuggestsTypesForTypingErrors) {
  EXPECT_EQ(similar_message_names("geometry_msgs/Twits").front(), "geometry_msgs/Twist");
  EXPECT_EQ(similar_message_names("geometri_msgs/twist").front(), "geometry_msgs/Twist");
  EXPECT_EQ(similar_service_names("std_srvs/SetBol").front(), "std_srvs/SetBool");
}

TEST(Registry, SuggestsTheTypeOfAnotherPackage) {
  EXPECT_EQ(similar_message_names("std_msgs/Twist").front(), "geometry_msgs/Twist");
  EXPECT_EQ(similar_message_names("Twist").front(), "geometry_msgs/Twist");
}

TEST(Registry, SuggestsNothingForWhatResemblesNothing) {
  EXPECT_TRUE(similar_message_names("my_robot/BatteryChemistryReport").empty());
}

TEST(Registry, SuggestsAtMostThree) { EXPECT_LE(similar_message_names("std_msgs/Int").size(), 3U); }

TEST(Registry, FieldKeysAreTheSameForTheSameName) {
  EXPECT_EQ(field_key("linear"), find_message("geometry_msgs/Twist")->fields[0].key);
  EXPECT_NE(field_key("linear"), field_key("angular"));
}

TEST(Registry, AnswersManyThreadsAlike) {
  std::vector<const MessageType*> found(8);
  std::vector<std::uint32_t> keys(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back([&, i] {
      found[i] = find_message("nav_msgs/Odometry");
      keys[i] = field_key("a_name_that_nobody_uses");
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::count(found.begin(), found.end(), found[0]), 8);
  EXPECT_EQ(std::count(keys.begin(), keys.end(), keys[0]), 8);
}

/// Results are kept by address: g++ 14 takes a reference for one to the temporary arguments (-Wdangling-reference).
MessageType small_type(const std::string& name, const std::string& md5) {
  Field field;
  field.name = "linear";
  field.kind = FieldKind::kMessage;
  field.message = find_message("geometry_msgs/Vector3");
  return {name, md5, "geometry_msgs/Vector3 linear\n", false, {field}, {}};
}

TEST(AddedTypes, AreFoundAndHaveFieldKeys) {
  const MessageType* added = &add_message(small_type("added_msgs/Small", "1"));
  EXPECT_EQ(find_message("added_msgs/msg/Small"), added);
  EXPECT_EQ(added->fields[0].key, field_key("linear"));
}

TEST(AddedTypes, AreNotAmongTheListedNames) {
  add_message(small_type("added_msgs/Unnamed", "1"));
  const std::vector<std::string> names = message_names();
  EXPECT_FALSE(std::binary_search(names.begin(), names.end(), "added_msgs/Unnamed"));
}

TEST(AddedTypes, AreAddedOnce) {
  const MessageType* first = &add_message(small_type("added_msgs/Once", "1"));
  EXPECT_EQ(&add_message(small_type("added_msgs/Once", "1")), first);
}

TEST(AddedTypes, CannotReplaceADifferentType) {
  add_message(small_type("added_msgs/Fixed", "1"));
  EXPECT_THROW(add_message(small_type("added_msgs/Fixed", "2")), std::invalid_argument);
  EXPECT_THROW(add_message(small_type("geometry_msgs/Twist", "2")), std::invalid_argument);
}

TEST(AddedTypes, MayBeServices) {
  const ServiceType* added = &add_service("added_msgs/Serve", "3", small_type("added_msgs/ServeRequest", "1"),
                                          small_type("added_msgs/ServeResponse", "2"));
  EXPECT_EQ(find_service("added_msgs/srv/Serve"), added);
  EXPECT_EQ(find_message("added_msgs/ServeResponse"), added->response);
}

TEST(AddedTypes, StayWhereTheyAreWhileThreadsAddMore) {
  const MessageType* first = &add_message(small_type("added_msgs/First", "1"));
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([thread] {
      for (int i = 0; i < 200; ++i) {
        add_message(small_type("added_msgs/Many" + std::to_string(i % 50 + thread), "1"));
        find_message("added_msgs/First");
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(find_message("added_msgs/First"), first);
  EXPECT_EQ(first->fields[0].message, find_message("geometry_msgs/Vector3"));
}

TEST(MinimumSize, CountsLengthsAndFixedArrays) {
  EXPECT_EQ(minimum_size(*find_message("geometry_msgs/Twist")), 48U);
  // Header: seq, stamp, empty frame_id.
  EXPECT_EQ(minimum_size(*find_message("std_msgs/Header")), 4U + 8U + 4U);
  EXPECT_EQ(minimum_size(*find_message("geometry_msgs/PoseWithCovariance")), 8U * (3 + 4 + 36));
  EXPECT_EQ(minimum_size(*find_message("tf2_msgs/TFMessage")), 4U);
  EXPECT_EQ(minimum_size(*find_message("std_msgs/Empty")), 0U);
}

TEST(Kinds, HaveTheNamesAndSizesOfTheMessageLanguage) {
  EXPECT_EQ(kind_name(FieldKind::kFloat32), "float32");
  EXPECT_EQ(wire_size(FieldKind::kFloat32), 4U);
  EXPECT_EQ(kind_name(FieldKind::kMessage), "message");
  EXPECT_EQ(kind_of("float32"), FieldKind::kFloat32);
  EXPECT_THROW(kind_of("flaot32"), std::invalid_argument);
  EXPECT_EQ(wire_size(FieldKind::kString), 0U);
  EXPECT_EQ(wire_size(FieldKind::kTime), 8U);
}

}  // namespace
}  // namespace bubblesim::messages
