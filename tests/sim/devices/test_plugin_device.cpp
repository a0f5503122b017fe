// SPDX-License-Identifier: BSD-3-Clause
// Devices of the user: their parameters, the parts that they find, and what happens when they throw.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/plugin_device.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_plugin_device {
namespace {

PluginDescription plugin() {
  const Source source{"robot.sdf", 12};
  return {"mine",
          "libmine.so",
          {{"link", " link ", {}, source},
           {"gain", " +2.5e1\n", {}, source},
           {"axis", "0 -1  0.5", {}, source},
           {"on", "1", {}, source},
           {"odd", "1 2", {}, source},
           {"endless", "inf", {}, source}},
          {"robot.sdf", 11}};
}

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(PluginParameters, AreReadByNameAndKind) {
  const PluginDescription described = plugin();
  const PluginParameters parameters(described);
  EXPECT_EQ(parameters.text("link"), "link");
  EXPECT_EQ(parameters.number("gain"), 25);
  EXPECT_EQ(parameters.number("none", 3), 3);
  EXPECT_TRUE(parameters.flag("on", false));
  EXPECT_TRUE(parameters.vector("axis", {}).isApprox(Vector3(0, -1, 0.5)));
  EXPECT_EQ(parameters.names_read(), (std::set<std::string>{"axis", "gain", "link", "none", "on"}));
}

TEST(PluginParameters, ThatCannotBeReadAreErrorsWithTheirPlace) {
  const PluginDescription described = plugin();
  const PluginParameters parameters(described);
  EXPECT_EQ(error_of([&] { parameters.number("odd"); }),
            "robot.sdf:12: plugin 'mine': <odd> is '1 2', it must be a number");
  EXPECT_EQ(error_of([&] { parameters.number("endless", 1); }),
            "robot.sdf:12: plugin 'mine': <endless> is 'inf', it must be a number");
  EXPECT_EQ(error_of([&] { parameters.vector("odd", {}); }),
            "robot.sdf:12: plugin 'mine': <odd> is '1 2', it must be three numbers");
  EXPECT_EQ(error_of([&] { parameters.flag("odd", true); }),
            "robot.sdf:12: plugin 'mine': <odd> is '1 2', it must be true or false");
  EXPECT_EQ(error_of([&] { parameters.text("none"); }), "robot.sdf:11: plugin 'mine': <none> is missing");
}

TEST(PluginPlace, FindsThePartsOfItsModel) {
  Simulation simulation(scene({model("Body", link_with(Box{{1, 1, 1}}), at(0, 0, 1))}));
  const PluginDescription described = plugin();
  const PluginParameters parameters(described);
  const ObjectId body = simulation.world().tree().find("/Body");
  const PluginPlace place{simulation.world(), body, body, parameters, ""};
  EXPECT_EQ(place.link("link"), simulation.world().tree().find("/Body/link"));
  EXPECT_EQ(error_of([&] { place.joint("link"); }),
            "robot.sdf:12: plugin 'mine': <link> is 'link', which is not a joint of /Body");
}

/// Throws from its third update on.
class Failing : public PluginDevice {
 public:
  void load(const PluginPlace&) override {}
  void update(World&, double, double) override {
    if (++updates > 2) throw std::runtime_error("out of fuel");
  }
  int updates = 0;
};

TEST(SwitchedDevice, IsNotCalledAfterAnException) {
  Simulation simulation(scene({model("Body", link_with(Box{{1, 1, 1}}), at(0, 0, 1))}));
  const auto failing = std::make_shared<Failing>();
  const auto device = std::make_shared<SwitchedDevice>(failing);
  simulation.world().devices().add(device);
  simulation.step();
  EXPECT_EQ(failing->updates, 3);
  EXPECT_EQ(device->failure(), "update(): out of fuel");
}

/// Throws what is no exception class.
class Odd : public Failing {
 public:
  void reset(World&) override { throw 1; }
};

TEST(SwitchedDevice, StandsWhateverIsThrown) {
  Simulation simulation(scene({model("Body", link_with(Box{{1, 1, 1}}), at(0, 0, 1))}));
  SwitchedDevice device(std::make_shared<Odd>());
  device.reset(simulation.world());
  EXPECT_EQ(device.failure(), "reset(): an exception that is not derived from std::exception");
}

}  // namespace
}  // namespace bubblesim::test::test_plugin_device
