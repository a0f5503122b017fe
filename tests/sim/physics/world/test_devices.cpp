// SPDX-License-Identifier: BSD-3-Clause
// Devices: when they are called, and that their wrenches act until their next update.
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "bubblesim/device.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/state_archive.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_devices {
namespace {

constexpr double kMillisecond = 0.001;

SceneDescription balls() {
  return scene({model("First", link("link"), at(0, 0, 0)), model("Second", link("link"), at(5, 0, 0))},
               Vector3::Zero());
}

/// Records its calls.
struct Recorder : Device {
  void update(World&, double time, double duration) override {
    times.push_back(time);
    durations.push_back(duration);
  }
  void reset(World&) override { ++resets; }
  void transfer(StateArchive& archive) override { archive(value); }

  std::vector<double> times;
  std::vector<double> durations;
  int resets = 0;
  double value = 0;
};

/// A constant push.
struct Pusher : Device {
  Pusher(ObjectId link, double force) : link_(link), force_(force) {}
  void update(World& world, double, double) override { world.wrenches().apply(link_, {{force_, 0, 0}, {}}); }

  ObjectId link_;
  double force_;
};

class Devices : public ::testing::Test {
 protected:
  std::shared_ptr<Recorder> add(double rate) {
    auto device = std::make_shared<Recorder>();
    world.devices().add(device, kNoObject, rate);
    return device;
  }
  static void expect_near(const std::vector<double>& found, const std::vector<double>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-9) << i;
  }

  World world{balls(), 0};
};

TEST_F(Devices, At1kHzAreCalledBeforeEachMillisecond) {
  const auto device = add(1000);
  world.advance(5 * kMillisecond, kMillisecond);
  expect_near(device->times, {0, 0.001, 0.002, 0.003, 0.004});
  expect_near(device->durations, {0.001, 0.001, 0.001, 0.001, 0.001});
}

TEST_F(Devices, At500HzAreCalledEverySecondMillisecond) {
  const auto device = add(500);
  world.advance(3 * kMillisecond, kMillisecond);  // the schedule goes on in the next step
  world.advance(4 * kMillisecond, kMillisecond);
  expect_near(device->times, {0, 0.002, 0.004, 0.006});
  expect_near(device->durations, {0.002, 0.002, 0.002, 0.002});
}

TEST_F(Devices, WithoutARateAreCalledBeforeEachSubstep) {
  const auto device = add(0);
  world.advance(0.05, 0.005);
  EXPECT_EQ(device->times.size(), 10U);
  EXPECT_NEAR(device->durations.back(), 0.005, 1e-12);
}

TEST_F(Devices, FasterThanTheSubstepsAreCalledOnceInEach) {
  const auto device = add(10000);
  world.advance(0.05, 0.005);
  EXPECT_EQ(device->times.size(), 10U);
}

TEST_F(Devices, KeepTheirRateInTheMeanWhenSubstepsDoNotDivideIt) {
  const auto device = add(300);
  world.advance(10, kMillisecond);
  EXPECT_NEAR(static_cast<double>(device->times.size()), 3000, 1);
  for (std::size_t i = 1; i < device->times.size(); ++i) {
    ASSERT_NEAR(device->times[i], device->times[i - 1] + device->durations[i - 1], 1e-9) << "without gaps";
  }
}

TEST_F(Devices, ReceiveTheGivenTime) {
  const auto device = add(0);
  world.advance(0.01, 0.005, 7.0);
  expect_near(device->times, {7, 7.005});
}

TEST_F(Devices, AreCalledInTheOrderInWhichTheyWereAdded) {
  struct Named : Device {
    Named(std::vector<int>& log, int name) : log_(log), name_(name) {}
    void update(World&, double, double) override { log_.push_back(name_); }
    std::vector<int>& log_;
    int name_;
  };
  std::vector<int> log;
  for (const int name : {1, 2, 3}) world.devices().add(std::make_shared<Named>(log, name));
  world.advance(0.01, 0.005);
  EXPECT_EQ(log, (std::vector<int>{1, 2, 3, 1, 2, 3}));
}

TEST_F(Devices, PushUntilTheirNextUpdate) {
  const ObjectId link = world.tree().find("/First/link");
  world.devices().add(std::make_shared<Pusher>(link, 3.0), kNoObject, 100);
  for (int i = 0; i < 10; ++i) world.advance(0.1, kMillisecond);
  EXPECT_NEAR(world.velocity(link).linear.x(), 3.0, 1e-9) << "3 N during 1 s on 1 kg";
  EXPECT_NEAR(world.pose(link).position.x(), 1.5, 2e-3);
}

TEST_F(Devices, CommandJoints) {
  struct Servo : Device {
    void update(World& servo_world, double, double) override {
      const ObjectId hinge = servo_world.tree().find("/joint");
      const double wanted = 0.5;
      servo_world.joints().set_target_effort(
          hinge, 100 * (wanted - servo_world.joints().position(hinge)) - 20 * servo_world.joints().velocity(hinge));
    }
  };
  JointDescription hinge = joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kEffort)}, {}, "world");
  World arm(jointed(hinge), 0);
  arm.devices().add(std::make_shared<Servo>(), arm.tree().find("/Robot"), 1000);
  arm.advance(3, kMillisecond);
  EXPECT_NEAR(arm.joints().position(arm.tree().find("/joint")), 0.5, 1e-6) << "a PD controller at 1 kHz";
}

TEST_F(Devices, AreNotifiedOfAReset) {
  const auto device = add(100);
  world.advance(0.003, kMillisecond);
  world.reset();
  EXPECT_EQ(device->resets, 1);
  world.advance(0.003, kMillisecond);
  expect_near(device->times, {0, 0});
}

TEST_F(Devices, StartAgainIdenticallyAfterAReset) {
  const ObjectId link = world.tree().find("/First/link");
  world.devices().add(std::make_shared<Pusher>(link, 3.0), kNoObject, 300);
  const auto run = [&] {
    world.advance(0.123, kMillisecond);
    return world.state_hash();
  };
  const std::uint64_t first = run();
  world.reset();
  EXPECT_EQ(run(), first);
}

TEST_F(Devices, ArePartOfTheStateHash) {
  const auto device = add(100);
  const std::uint64_t before = world.state_hash();
  device->value = 1;
  EXPECT_NE(world.state_hash(), before);
}

TEST_F(Devices, LeaveWithTheirModel) {
  const ObjectId first = world.tree().find("/First");
  const ObjectId link = world.tree().find("/First/link");
  world.devices().add(std::make_shared<Pusher>(link, 3.0), first);
  world.advance(0.01, 0.005);
  world.models().remove(first);
  EXPECT_NO_THROW(world.advance(0.01, 0.005));
}

TEST_F(Devices, CanBeRemoved) {
  const auto device = add(0);
  world.devices().remove(*device);
  world.devices().remove(*device);
  world.advance(0.01, 0.005);
  EXPECT_TRUE(device->times.empty());
  EXPECT_EQ(world.state_hash(), [] {
    World other(balls(), 0);
    other.advance(0.01, 0.005);
    return other.state_hash();
  }());
}

TEST_F(Devices, InvalidOnesAreRefused) {
  EXPECT_THROW(world.devices().add(nullptr), InvalidInput);
  EXPECT_THROW(world.devices().add(std::make_shared<Recorder>(), kNoObject, -1), InvalidInput);
  EXPECT_THROW(world.devices().add(std::make_shared<Recorder>(), kNoObject, kNaN), InvalidInput);
  EXPECT_THROW(world.devices().add(std::make_shared<Recorder>(), world.tree().find("/First/link")), WrongObject);
  EXPECT_THROW(world.devices().add(std::make_shared<Recorder>(), 12345), NoSuchObject);
  struct Adder : Device {
    void update(World& its_world, double, double) override { its_world.devices().add(std::make_shared<Recorder>()); }
  };
  world.devices().add(std::make_shared<Adder>());
  EXPECT_THROW(world.advance(0.01, 0.005), std::logic_error);
}

TEST_F(Devices, OfASimulationReceiveSimulationTime) {
  Simulation simulation(balls());
  auto device = std::make_shared<Recorder>();
  simulation.world().devices().add(device);
  simulation.step();
  simulation.reset_world();  // time goes on
  simulation.step();
  ASSERT_EQ(device->times.size(), 20U);
  EXPECT_NEAR(device->times.front(), 0, 1e-12);
  EXPECT_NEAR(device->times[10], 0.05, 1e-12);
  EXPECT_NEAR(device->times.back(), 0.095, 1e-12);
}

}  // namespace
}  // namespace bubblesim::test::test_devices
