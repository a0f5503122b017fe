// SPDX-License-Identifier: BSD-3-Clause
// Custom data, old paths, main scripts and image filters in files of CoppeliaSim.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "load/ttt/left_out.hpp"
#include "load/ttt/main_script.hpp"
#include "load/ttt/old_path.hpp"
#include "load/ttt/scene_file.hpp"
#include "ttt_writer.hpp"

namespace bubblesim::test::test_ttt_data {
namespace {

using namespace bubblesim::ttt;
using namespace ttt_writer;
using Data = std::map<std::string, std::string>;

ttt::Object read(const ObjectText& object) { return read_scene_file(file({object})).objects.at(0); }

/// A block of old custom data: its size, that of the name with its zero byte, the name, the data.
std::string block(const std::string& name, const std::string& data) {
  const auto name_size = static_cast<std::int32_t>(name.size()) + 1;
  return ints({8 + name_size + static_cast<std::int32_t>(data.size()), name_size}) + name + '\0' + data;
}

ObjectText with_old_data(std::int32_t number, const std::string& content) {
  ObjectText dummy{"DMY", 1, -1, "dummy"};
  const std::string data = ints({number, static_cast<std::int32_t>(content.size())}) + content;
  dummy.common = item("Cod", item("Dat", data) + "EOO");
  return dummy;
}

constexpr std::int32_t kByName = 356248756;

TEST(TttCustomData, OfFilesBeforeV44IsFoundByName) {
  const ttt::Object object =
      read(with_old_data(kByName, block("PATH", "points") + block("empty", "") + block("x", "y")));
  EXPECT_EQ(object.data, (Data{{"PATH", "points"}, {"empty", ""}, {"x", "y"}}));
}

TEST(TttCustomData, WithoutANameIsFoundByItsNumber) {
  EXPECT_EQ(read(with_old_data(1234, "bytes")).data, (Data{{"#1234", "bytes"}}));
}

TEST(TttCustomData, OfLaterFilesReplacesTheOldCopy) {
  ObjectText dummy = with_old_data(kByName, block("a", "old"));
  dummy.common += item("Cda", item("Cdt", text("a") + text("new")) + "EOO");
  EXPECT_EQ(read(dummy).data, (Data{{"a", "new"}}));
}

TEST(TttCustomData, WithAnImpossibleSizeIsReported) {
  for (const auto& [size, name_size] : {std::pair{7, 2}, {100, 2}, {12, -1}, {12, 1 << 30}}) {
    const SceneFile scene = read_scene_file(file({with_old_data(kByName, ints({size, name_size}) + "ab\0c")}));
    ASSERT_EQ(scene.damaged.size(), 1U);
    EXPECT_EQ(scene.damaged[0].object, "dummy");
  }
}

std::vector<std::array<double, 7>> poses_in(const std::string& bytes) {
  std::vector<std::array<double, 7>> poses(bytes.size() / sizeof(std::array<double, 7>));
  std::memcpy(poses.data(), bytes.data(), poses.size() * sizeof poses[0]);
  return poses;
}

/// A point of an old path with curves of `count` points that begin half-way to its neighbours.
std::string point(float x, float y, int count) {
  return item("Pat", item("At2", floats({x, y, 0, 1, 0, 0, 0, 0.5, 0.5}) + ints({count}) + floats({1})) + "EOO");
}

ObjectText path(const std::string& points, int attributes) {
  return {"PAT", 1, -1, "path", {1, 0, 0, 0, 0, 0, 0}, "", item("Ntp", points + item("At2", ints({attributes})))};
}

TEST(TttOldPath, IsACurveThatRoundsItsCorners) {
  const ttt::Object object = read(path(point(0, 0, 3) + point(2, 0, 3) + point(2, 2, 3), 0));
  const Data data = data_of(*object.as<Path>());
  EXPECT_EQ(poses_in(data.at("PATHCTRLPTS")).size(), 3U);
  const auto poses = poses_in(data.at("PATH"));
  ASSERT_EQ(poses.size(), 5U);
  EXPECT_EQ(poses[0], (std::array<double, 7>{0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(poses[1], (std::array<double, 7>{1, 0, 0, 0, 0, 0, 1}));
  // A quadratic Bezier curve at its middle: a quarter of each end and a half of the corner.
  EXPECT_EQ(poses[2], (std::array<double, 7>{1.75, 0.25, 0, 0, 0, 0, 1}));
  EXPECT_EQ(poses[3], (std::array<double, 7>{2, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(poses[4], (std::array<double, 7>{2, 2, 0, 0, 0, 0, 1}));
}

TEST(TttOldPath, EndsWhereItBeginsIfItIsClosed) {
  constexpr int kClosed = 4;
  const ttt::Object object = read(path(point(0, 0, 1) + point(2, 0, 1) + point(2, 2, 1), kClosed));
  const auto poses = poses_in(data_of(*object.as<Path>()).at("PATH"));
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_EQ(poses[0], poses[3]);
}

TEST(TttOldPath, WithoutPointsIsNoPath) { EXPECT_TRUE(data_of(*read(path("", 0)).as<Path>()).empty()); }

TEST(TttMainScript, ThatCallsThePhasesDoesNothingElse) {
  EXPECT_TRUE(
      calls_beside_phases("-- sim.setX()\nsim.handleDynamics(sim.getSimulationTimeStep()) --[[ sim.setX\n() ]]\n"
                          "simHandleChildScript(sim_handle_all_except_explicit)\nprint(simulated(1))")
          .empty());
}

TEST(TttMainScript, NamesTheOtherFunctionsThatItCalls) {
  EXPECT_EQ(calls_beside_phases("simSetJointPosition(a, 1)\nsim.addLog (1)\nsimExtStart(sim.handleDynamics(0))"),
            (std::set<std::string>{"sim.addLog", "sim.extStart", "sim.setJointPosition"}));
}

ObjectText camera(const std::vector<int>& filters) {
  std::string list;
  for (const int kind : filters) list += item("Sfr", item("Sft", ints({kind, -1, -1})) + item("Sfe", byte(1)) + "EOO");
  return {"RSN", 1, -1, "camera", {1, 0, 0, 0, 0, 0, 0}, "", item("Cfr", list + "EOO")};
}

TEST(TttFilters, ThatPassTheImageOnAreNone) {
  constexpr int kFromView = 1;
  constexpr int kScale = 15;
  constexpr int kToOutput = 4;
  EXPECT_FALSE(read(camera({kFromView, kToOutput})).as<VisionSensor>()->has_filters);
  EXPECT_TRUE(read(camera({kFromView, kScale, kToOutput})).as<VisionSensor>()->has_filters);
}

}  // namespace
}  // namespace bubblesim::test::test_ttt_data
