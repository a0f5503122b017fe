// SPDX-License-Identifier: BSD-3-Clause
// Values of structs that list their members.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>

#include "bubblesim/any_record.hpp"
#include "bubblesim/sensor_kinds.hpp"

namespace bubblesim::test::test_any_record {
namespace {

/// Larger than a record holds in itself, and counts its objects.
struct Large {
  std::array<double, 64> numbers{};
  std::shared_ptr<int> owner = std::make_shared<int>(0);
  double first = 0;

  static const MemberTable& members() {
    static const MemberTable table =
        member_table<Large>("Large", "", {member<&Large::first>("first", "", "the first one")});
    return table;
  }
};

TEST(AnyRecord, IsEmptyAtFirst) {
  const AnyRecord record{};
  EXPECT_EQ(record.table(), nullptr);
  EXPECT_EQ(record.get_if<ImuReading>(), nullptr);
  EXPECT_THROW(record.get<ImuReading>(), std::logic_error);
  const AnyRecord copy = record;
  EXPECT_EQ(copy.table(), nullptr);
}

TEST(AnyRecord, HoldsOneStruct) {
  AnyRecord record = AltimeterReading{3, 4};
  EXPECT_TRUE(record.holds<AltimeterReading>());
  EXPECT_FALSE(record.holds<ImuReading>());
  EXPECT_EQ(record.get<AltimeterReading>().velocity, 4);
  EXPECT_EQ(record.get_if<ImuReading>(), nullptr);
  EXPECT_THROW(record.get<ImuReading>(), std::logic_error);
  record = ContactDescription{{"a name that is too long to be held in the string itself"}};
  EXPECT_EQ(record.get<ContactDescription>().collisions.size(), 1U);
}

TEST(AnyRecord, CopiesAreIndependent) {
  AnyRecord record = ContactDescription{{"wheel"}};
  AnyRecord copy = record;
  copy.get<ContactDescription>().collisions[0] = "bumper";
  EXPECT_EQ(record.get<ContactDescription>().collisions[0], "wheel");
  record = copy;
  EXPECT_EQ(record.get<ContactDescription>().collisions[0], "bumper");
  copy = AltimeterReading{1, 2};
  EXPECT_EQ(record.get<ContactDescription>().collisions[0], "bumper");
}

TEST(AnyRecord, AssignsAnEqualStructInPlace) {
  LidarScan scan;
  scan.ranges.assign(1000, 1);
  AnyRecord record = scan;
  const float* ranges = record.get<LidarScan>().ranges.data();
  scan.ranges.assign(1000, 2);
  record = scan;
  EXPECT_EQ(record.get<LidarScan>().ranges.data(), ranges);
  record = AnyRecord(scan);
  EXPECT_EQ(record.get<LidarScan>().ranges[999], 2);
}

TEST(AnyRecord, HoldsTheReadingsInItself) {
  for (const std::size_t size :
       {sizeof(ProximityReading), sizeof(LidarScan), sizeof(CameraImage), sizeof(ImuReading), sizeof(NavSatReading),
        sizeof(AltimeterReading), sizeof(MagnetometerReading), sizeof(ContactReading), sizeof(ForceTorqueReading)}) {
    EXPECT_LE(size, AnyRecord::kInline) << "a measurement would allocate";
  }
}

TEST(AnyRecord, FreesWhatItHolds) {
  Large large;
  large.first = 5;
  const std::shared_ptr<int> owner = large.owner;
  {
    AnyRecord record = std::move(large);
    AnyRecord copy = record;
    EXPECT_EQ(owner.use_count(), 3);
    AnyRecord moved = std::move(record);
    EXPECT_EQ(moved.get<Large>().first, 5);
    EXPECT_EQ(owner.use_count(), 3);
    copy = AltimeterReading{};
    EXPECT_EQ(owner.use_count(), 2);
    moved = copy;
    EXPECT_EQ(owner.use_count(), 1);
  }
  EXPECT_EQ(owner.use_count(), 1);
}

}  // namespace
}  // namespace bubblesim::test::test_any_record
