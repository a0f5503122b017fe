// SPDX-License-Identifier: BSD-3-Clause
// A kind of sensor that a program adds, in one file and one line: all else follows from the lists of its members.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/quantity.hpp"
#include "bubblesim/scene_elements.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/sensor_definition.hpp"
#include "bubblesim/simulation.hpp"
#include "scene_files.hpp"

extern "C" void add_rate_of_turn();

namespace bubblesim::test::test_added_kind {
namespace {

constexpr double kRate = 2;  // rad/s

class AddedKind : public testing::Test {
 protected:
  static void SetUpTestSuite() { add_rate_of_turn(); }
};

std::string with_sensor(const std::string& parameters) {
  return in_world(
      "<gravity>0 0 0</gravity><model name='Top'><link name='link'>"
      "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
      "<sensor name='Turn' type='rate_of_turn'>" +
      parameters + "</sensor></link></model>");
}

SceneDescription scene_with(const std::string& parameters) {
  const TemporaryFile file("turn.sdf", with_sensor(parameters));
  return read_scene(file.path());
}

std::shared_ptr<const Scene> prepared(const std::string& parameters) {
  return std::make_shared<const Scene>(scene_with(parameters));
}

void turn(Simulation& simulation) {
  simulation.world().set_velocity(simulation.world().tree().find("/Top"), {{}, {0, 0, kRate}});
}

double number(Simulation& simulation, const std::string& name) {
  const Quantities quantities(simulation, {name}, Quantities::Use::kObserve);
  std::vector<double> row(quantities.width());
  quantities.observe(simulation, Row(row.data(), NumberType::kFloat64));
  return row.back();
}

TEST_F(AddedKind, LoadsAndMeasures) {
  Simulation simulation(prepared(""));
  turn(simulation);
  simulation.step();
  EXPECT_EQ(simulation.sensor_kind(simulation.world().tree().find("/Turn")), "rate-of-turn sensor");
  EXPECT_NEAR(number(simulation, "/Turn.rate_of_turn"), kRate, 1e-9);
}

TEST_F(AddedKind, HasItsParametersAndNoiseFromTheFile) {
  Simulation cut(prepared("<rate_of_turn><max_rate>0.5</max_rate></rate_of_turn>"));
  turn(cut);
  EXPECT_EQ(number(cut, "/Turn.rate_of_turn"), 0.5);
  Simulation biased(
      prepared("<rate_of_turn><noise type='gaussian'><bias_mean>0.25</bias_mean></noise></rate_of_turn>"));
  EXPECT_EQ(number(biased, "/Turn.rate_of_turn"), 0.25);
}

TEST_F(AddedKind, HasQuantitiesOfTheSizesOfItsMembers) {
  Simulation simulation(prepared(""));
  const Quantities quantities(simulation, {"/Turn.turn_axis", "/Turn.rate_of_turn"}, Quantities::Use::kObserve);
  ASSERT_EQ(quantities.list().size(), 2U);
  EXPECT_EQ(quantities.list()[0].shape, Sizes{3});
  EXPECT_EQ(quantities.list()[1].shape, Sizes{});
  EXPECT_EQ(number(simulation, "/Turn.turn_axis"), 1) << "z";
}

TEST_F(AddedKind, ChangesTheHashOfAScene) {
  const auto hash = [](const std::string& parameters) { return prepared(parameters)->hash(); };
  const std::string slow = "<rate_of_turn><max_rate>1</max_rate></rate_of_turn>";
  const std::string noisy = "<rate_of_turn><noise type='gaussian'><stddev>1</stddev></noise></rate_of_turn>";
  EXPECT_EQ(hash(""), hash(""));
  EXPECT_NE(hash(""), hash(slow));
  EXPECT_NE(hash(""), hash(noisy));
  EXPECT_NE(hash(slow), hash(noisy));
}

TEST_F(AddedKind, IsKeptInSnapshots) {
  const auto scene = prepared("");
  Simulation simulation(scene);
  const ObjectId sensor = simulation.world().tree().find("/Turn");
  const auto rates = [&](Simulation& of) {
    const Measurement& measured = of.read(sensor)->measurement;
    const Member& rates = *measured.table()->find("rates");
    return *static_cast<const std::vector<float>*>(rates.get(measured.data()));
  };
  turn(simulation);
  simulation.read(sensor);
  simulation.step();
  const std::vector<float> before = rates(simulation);
  ASSERT_EQ(before.size(), 3U);
  EXPECT_NEAR(before[2], kRate, 1e-6);
  const std::string state = simulation.save();
  Simulation other(scene);
  other.restore(state);
  EXPECT_EQ(rates(other), before);
  EXPECT_EQ(other.save(), simulation.save());
}

TEST_F(AddedKind, IsCheckedWithTheLimitsOfItsMembers) {
  const TemporaryFile file("turn.sdf", with_sensor("<rate_of_turn><max_rate>-1</max_rate><noise type='gaussian'>"
                                                   "<stddev>1e9</stddev></noise></rate_of_turn>"));
  try {
    load_scene(file.path());
    FAIL() << "the scene has wrong numbers";
  } catch (const SceneError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("the max rate is -1 rad/s, it must be 0 to 100 rad/s"), std::string::npos) << text;
    EXPECT_NE(text.find("the noise's standard deviation or precision is 1e+09"), std::string::npos) << text;
  }
}

TEST_F(AddedKind, HasItsElementsInTheReference) {
  const std::vector<SceneElement> elements = scene_elements();
  const std::string path = "world/model/link/sensor/rate_of_turn/max_rate";
  const auto found =
      std::find_if(elements.begin(), elements.end(), [&](const auto& each) { return each.path == path; });
  ASSERT_NE(found, elements.end());
  EXPECT_EQ(found->default_text, "10");
}

TEST_F(AddedKind, CannotBeAddedTwice) { EXPECT_THROW(add_rate_of_turn(), InvalidInput); }

}  // namespace
}  // namespace bubblesim::test::test_added_kind
