// SPDX-License-Identifier: BSD-3-Clause
// What restore() refuses, and that it changes nothing then.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bubblesim/device.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/planar_drive.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/timed_efforts.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_refused_snapshots {
namespace {

void run(Simulation& simulation, int steps) {
  for (int step = 0; step < steps; ++step) simulation.step();
}

std::string error_of(Simulation& simulation, const std::string& state) {
  const std::uint64_t before = simulation.state_hash();
  try {
    simulation.restore(state);
  } catch (const InvalidInput& error) {
    EXPECT_EQ(simulation.state_hash(), before);
    return error.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RefusedSnapshot, RefusesBytesThatAreNoStateOfItsScene) {
  Simulation simulation(load_scene("tricycle"));
  simulation.step();
  const std::string saved = simulation.save();
  EXPECT_TRUE(has(error_of(simulation, ""), "not a saved state"));
  EXPECT_TRUE(has(error_of(simulation, "something else, such as a picture"), "not a saved state"));
  EXPECT_TRUE(has(error_of(simulation, saved.substr(0, 20)), "cut"));
  EXPECT_TRUE(has(error_of(simulation, saved.substr(0, saved.size() - 1)), "damaged"));
  std::string changed = saved;
  changed[saved.size() / 2] = static_cast<char>(changed[saved.size() / 2] ^ 1);
  EXPECT_TRUE(has(error_of(simulation, changed), "damaged"));
  std::string older = saved;
  older[16] = static_cast<char>(older[16] + 1);
  EXPECT_TRUE(has(error_of(simulation, older), "version"));
  Simulation other(load_scene("bubblerob"));
  EXPECT_TRUE(has(error_of(other, saved), "another scene"));
  EXPECT_EQ(error_of(simulation, saved), "no error");
}

TEST(RefusedSnapshot, RefusesAWorldWithoutItsModels) {
  Simulation simulation(scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 2))}));
  const std::string saved = simulation.save();
  simulation.remove_model(simulation.world().tree().find("/Box"));
  EXPECT_TRUE(has(error_of(simulation, saved), "removed since"));
}

TEST(RefusedSnapshot, RestoresCutAndChangedBytesOrLeavesTheWorldAsItIs) {
  Simulation simulation(load_scene("tricycle"), 2);
  run(simulation, 5);
  const std::string saved = simulation.save();
  run(simulation, 4);
  const std::string before = simulation.save();
  for (std::size_t size = 0; size < saved.size(); size += 13) {
    EXPECT_NE(error_of(simulation, saved.substr(0, size)), "no error") << size << " bytes";
  }
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    std::string changed = saved;
    const std::size_t place = random() % saved.size();
    changed[place] = static_cast<char>(changed[place] ^ (1U << random() % 8));
    EXPECT_NE(error_of(simulation, changed), "no error") << "byte " << place;
  }
  EXPECT_TRUE(simulation.save() == before);
  EXPECT_EQ(error_of(simulation, saved), "no error");
}

/// What a refused state must not change beside the hash: the models that were added, and all that is saved.
void expect_refused(Simulation& simulation, const std::string& state, const std::string& why) {
  const std::vector<ObjectId> models = simulation.world().tree().models();
  const std::string before = simulation.save();
  const std::string error = error_of(simulation, state);
  EXPECT_TRUE(has(error, why)) << error;
  EXPECT_EQ(simulation.world().tree().models(), models);
  EXPECT_TRUE(simulation.save() == before) << why;
}

SceneDescription box_on_a_floor() { return scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 2))}); }

TEST(RefusedSnapshot, KeepsTheModelsThatWereAddedWhenADeviceIsMissing) {
  Simulation with_device(box_on_a_floor());
  with_device.world().devices().add(std::make_shared<TimedEfforts>());
  run(with_device, 3);
  const std::string saved = with_device.save();
  Simulation without(box_on_a_floor());
  without.add_model(model("Other", link_with(Sphere{0.5}), at(0, 0, 4)));
  run(without, 5);
  expect_refused(without, saved, "number of devices");
  without.world().devices().add(std::make_shared<PlanarDrive>(without.world().tree().find("/Box")));
  expect_refused(without, saved, "kind of a device");
}

TEST(RefusedSnapshot, RefusesAnotherModelInThePlaceOfOneThatWasAdded) {
  const auto with = [](const Geometry& geometry) {
    auto made = std::make_unique<Simulation>(box_on_a_floor());
    made->add_model(model("Other", link_with(geometry), at(0, 0, 4)));
    run(*made, 4);
    return made;
  };
  const std::string saved = with(Sphere{0.5})->save();
  expect_refused(*with(Sphere{0.4}), saved, "description of a model");
  EXPECT_EQ(error_of(*with(Sphere{0.5}), saved), "no error");
}

/// Has a state, which it may refuse.
struct Keeper : System {
  explicit Keeper(std::string name_) : name(std::move(name_)) {}
  std::string state_name() const override { return name; }
  std::string save_state() override { return state; }
  void restore_state(std::string_view saved) override {
    if (refuses && saved != state) throw std::runtime_error("it does not want to");
    state = saved;
  }
  const std::string name;
  std::string state = "first";
  bool refuses = false;
};

TEST(RefusedSnapshot, IsPutBackWhenASystemIsMissingOrRefusesItsPart) {
  Simulation simulation(box_on_a_floor());
  Keeper one("one");
  Keeper two("two");
  simulation.add(one);
  simulation.add(two);
  run(simulation, 3);
  const std::string saved = simulation.save();
  run(simulation, 3);
  one.state = two.state = "second";
  two.refuses = true;
  const std::string before = simulation.save();
  EXPECT_THROW(simulation.restore(saved), std::runtime_error);
  EXPECT_TRUE(simulation.save() == before);
  EXPECT_EQ(one.state, "second");
  Simulation without(box_on_a_floor());
  run(without, 5);
  expect_refused(without, saved, "saved with one");
}

/// A device that takes more bytes than one of its kind has saved.
struct Wide : Device {
  explicit Wide(std::size_t count) : numbers(count, 1.0) {}
  void update(World&, double, double) override {}
  void transfer(StateArchive& archive) override {
    archive.require(numbers.size(), "numbers of the device");
    for (double& number : numbers) archive(number);
  }
  std::vector<double> numbers;
};

TEST(RefusedSnapshot, IsPutBackWhenADeviceRefusesItsPart) {
  Simulation narrow(box_on_a_floor());
  const auto first = std::make_shared<TimedEfforts>();
  narrow.world().devices().add(first);
  narrow.world().devices().add(std::make_shared<Wide>(2));
  run(narrow, 3);
  const std::string saved = narrow.save();
  Simulation wide(box_on_a_floor());
  wide.world().devices().add(std::make_shared<TimedEfforts>());
  wide.world().devices().add(std::make_shared<Wide>(3));
  wide.add_model(model("Other", link_with(Sphere{0.5}), at(0, 0, 4)));
  run(wide, 5);
  expect_refused(wide, saved, "numbers of the device");
}

}  // namespace
}  // namespace bubblesim::test::test_refused_snapshots
