// SPDX-License-Identifier: BSD-3-Clause
// Saved states: what follows restore() equals what followed save(), to the bit, on every scene.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/buoyancy.hpp"
#include "bubblesim/joint_ramps.hpp"
#include "bubblesim/planar_drive.hpp"
#include "bubblesim/planar_force_drive.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/timed_efforts.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_snapshot {
namespace {

/// What a simulation shows after each step: its saved state, with all sensors read in every third step.
std::vector<std::string> run(Simulation& simulation, int from, int to) {
  World& world = simulation.world();
  std::vector<std::string> states;
  for (int step = from; step < to; ++step) {
    for (const ObjectId id : world.tree().objects()) {
      const ObjectKind kind = world.tree().at(id).kind;
      if (kind == ObjectKind::kSensor && step % 3 == 0) simulation.read(id);
      if (kind != ObjectKind::kJoint || world.joints().axes(id) == 0 || step % 4 != 0) continue;
      world.joints().set_target_velocity(id, 3 * std::sin(0.7 * step + id));
      world.joints().set_target_position(id, std::sin(0.3 * step + id));
    }
    simulation.step();
    states.push_back(simulation.save());
  }
  return states;
}

void expect_equal(const std::vector<std::string>& found, const std::vector<std::string>& expected,
                  const std::string& what) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_TRUE(found[i] == expected[i]) << what << ": differs " << i + 1 << " steps after the restore";
  }
}

using Prepare = void (*)(Simulation&);

/// Saves in steps that a random number chooses, and compares the futures: in the same simulation, which went on
/// meanwhile, in a new one with another seed, and with that of a simulation that was never saved.
void expect_equal_futures(const std::shared_ptr<const Scene>& scene, const std::string& name, int steps,
                          Prepare prepare = nullptr) {
  constexpr int kFuture = 12;
  std::mt19937 random(static_cast<unsigned>(scene->hash()));
  Simulation simulation(scene, 5);
  if (prepare != nullptr) prepare(simulation);
  int now = 0;
  for (int round = 0; round < 3; ++round) {
    const int until = now + std::uniform_int_distribution<int>(0, steps)(random);
    run(simulation, now, until);
    now = until;
    const std::string saved = simulation.save();
    const std::vector<std::string> expected = run(simulation, now, now + kFuture);
    simulation.restore(saved);
    EXPECT_TRUE(simulation.save() == saved) << name;
    expect_equal(run(simulation, now, now + kFuture), expected, name + ", same simulation");
    Simulation other(scene, 17);
    if (prepare != nullptr) prepare(other);
    run(other, 0, round);
    other.restore(saved);
    expect_equal(run(other, now, now + kFuture), expected, name + ", other simulation");
    now += kFuture;
  }
}

TEST(Snapshot, KeepsTheFutureOfEveryScene) {
  for (const std::string& name : scene_names()) expect_equal_futures(load_scene(name), name, 30);
}

JointDescription driven(const std::string& type, const std::string& parent, const std::string& child, MotorMode mode) {
  JointDescription made = joint(type, {axis(Vector3::UnitY(), mode)}, {0, 0, 0}, parent, child);
  made.name = parent + "_" + child;
  made.axes[0].lower = -0.4;
  made.axes[0].upper = 0.5;
  made.axes[0].friction = 0.1;
  made.axes[0].spring_stiffness = 2;
  made.axes[0].damping = 0.1;
  return made;
}

/// A chain with limits, springs and motors that lies on the floor, under a heap of boxes.
SceneDescription heap() {
  std::vector<ModelDescription> models{floor(0.6)};
  ModelDescription arm = model("Arm", link_with(Box{{0.5, 0.3, 0.1}}), at(0, 0, 0.3));
  arm.links[0].name = "a";
  for (const char* name : {"b", "c"}) {
    LinkDescription next = link_with(Box{{0.5, 0.2, 0.1}});
    next.name = name;
    next.pose = at(name[0] == 'b' ? 0.6 : 1.2, 0, 0);
    next.inertia_diagonal = {0.1, 0.3, 0.35};
    arm.links.push_back(next);
  }
  arm.joints = {driven("revolute", "a", "b", MotorMode::kVelocity),
                driven("prismatic", "b", "c", MotorMode::kPosition)};
  models.push_back(arm);
  for (int i = 0; i < 12; ++i) {
    ModelDescription box = model("Box" + std::to_string(i), link_with(Box{{0.3, 0.25, 0.2}}),
                                 at(0.15 * (i % 4), 0.02 * i, 0.6 + 0.25 * i));
    box.links[0].inertia_diagonal = {0.01, 0.02, 0.03};
    if (i % 2 == 0) box.links[0].collisions[0].surface.rolling = 0.01;
    models.push_back(box);
  }
  return scene(std::move(models));
}

TEST(Snapshot, KeepsTheFutureOfAHeap) { expect_equal_futures(std::make_shared<const Scene>(heap()), "heap", 60); }

TEST(Snapshot, KeepsWhatSleepsAndWakes) {
  const auto scene =
      std::make_shared<const Scene>(test::scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 0.5)),
                                                 model("Upper", link_with(Box{{1, 1, 1}}), at(0, 0, 1.5)),
                                                 model("Ball", link_with(Sphere{0.2}), at(0.3, 0, 6))}));
  expect_equal_futures(scene, "sleep", 40);
}

TEST(Snapshot, KeepsDevices) {
  const auto scene = load_scene("tricycle");
  expect_equal_futures(scene, "devices", 20, [](Simulation& simulation) {
    World& world = simulation.world();
    const ObjectId robot = world.tree().find("/Tricycle");
    const ObjectId motor = world.tree().find("/FrontMotor");
    auto ramps = std::make_shared<JointRamps>(std::vector<double>{0.5},
                                              std::vector<JointRamps::Output>{{motor, MotorMode::kVelocity, {2}}});
    ramps->set_targets({3});
    world.devices().add(ramps, robot, 70);
    auto drive = std::make_shared<PlanarDrive>(robot);
    drive->set_velocity(0.2, 0.1, 0.3);
    world.devices().add(drive, robot);
    const ObjectId body = world.tree().parts(robot, ObjectKind::kLink)[0];
    auto pushed = std::make_shared<PlanarForceDrive>(world, body, PlanarForceDrive::Gains{50, 50, 5});
    pushed->set_velocity(0.1, -0.1, 0.2);
    world.devices().add(pushed, robot);
    auto efforts = std::make_shared<TimedEfforts>();
    efforts->add_wrench(world, body, {{3, 1, 0}, {}}, Vector3(0, 0.1, 0), {0.1, 0.4});
    world.devices().add(efforts);
    Wind::Variation variation;
    variation.speed_noise = 1;
    simulation.wind()->set_mean({1, 2, 0});
    simulation.wind()->set_variation(variation);
  });
}

TEST(Snapshot, KeepsMassSurfacesAndGravity) {
  const auto scene = std::make_shared<const Scene>(heap());
  expect_equal_futures(scene, "properties", 40, [](Simulation& simulation) {
    World& world = simulation.world();
    world.properties().set_mass(world.tree().find("/Arm"), 7.3);
    world.properties().set_friction(world.tree().find("/Floor"), 0.2);
    world.properties().set_slip(world.tree().find("/Box2/link"), {1, 1, 0}, 0.01, 0.02);
    world.properties().set_belt(world.tree().find("/Box4/link"), {0, 1, 0}, 0.3);
    world.properties().set_gravity({0, 1, -5});
  });
  Simulation simulation(scene, 5);
  const std::string start = simulation.save();
  World& world = simulation.world();
  world.set_planar_velocity(world.tree().find("/Box1"), 0.1, 0, 0);
  run(simulation, 0, 20);
  world.properties().set_mass(world.tree().find("/Box1"), 0.3);
  world.properties().set_friction(world.tree().find("/Box2"), 0.05);
  world.properties().set_gravity({0, 0, -2});
  const std::string saved = simulation.save();
  const std::vector<std::string> expected = run(simulation, 20, 40);
  Simulation other(scene, 6);
  other.restore(saved);
  EXPECT_EQ(other.world().properties().gravity().z(), -2);
  EXPECT_EQ(other.world().properties().mass(world.tree().find("/Box1")), 0.3);
  EXPECT_EQ(other.world().properties().friction(world.tree().find("/Box2")), 0.05);
  expect_equal(run(other, 20, 40), expected, "properties, other simulation");
  other.restore(start);
  EXPECT_TRUE(other.save() == start);
  EXPECT_EQ(other.world().properties().friction(world.tree().find("/Box2")), 1);
}

TEST(Snapshot, KeepsAttachments) {
  for (const Solver solver : {Solver::kBubblesim, Solver::kOde}) {
    SceneDescription described = heap();
    described.solver = solver;
    expect_equal_futures(std::make_shared<const Scene>(described),
                         solver == Solver::kOde ? "attachments, ODE" : "attachments", 40, [](Simulation& simulation) {
                           World& world = simulation.world();
                           world.attachments().attach(world.tree().find("/Arm/c"), world.tree().find("/Box1/link"));
                           world.attachments().attach(world.tree().find("/Box2/link"), world.tree().find("/Box3/link"));
                         });
  }
}

/// Two hinges of one model, of which the second mimics the first; both may turn by some turns.
SceneDescription winches() {
  ModelDescription machine = model("Machine", link("drum"));
  machine.links.push_back(link("dial", {1, 0, 0}));
  machine.joints = {joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "world", "drum"),
                    joint("revolute", {axis(Vector3::UnitZ())}, {1, 0, 0}, "world", "dial")};
  machine.joints[0].name = "winch";
  machine.joints[1].name = "pointer";
  machine.joints[0].axes[0].lower = -20;
  machine.joints[0].axes[0].upper = 20;
  MimicDescription mimic;
  mimic.joint = "winch";
  mimic.multiplier = 0.5;
  machine.joints[1].axes[0].mimic = mimic;
  return scene({machine}, Vector3::Zero());
}

TEST(Snapshot, KeepsFullTurns) {
  const auto scene = std::make_shared<const Scene>(winches());
  Simulation simulation(scene);
  simulation.world().joints().set_target_velocity(simulation.world().tree().find("/winch"), 4);
  for (int i = 0; i < 50; ++i) simulation.step();  // 2.5 s
  Simulation other(scene);
  other.restore(simulation.save());
  for (Simulation* each : {&simulation, &other}) {
    for (int i = 0; i < 10; ++i) each->step();
  }
  EXPECT_NEAR(other.world().joints().position(other.world().tree().find("/winch")), 12, 0.05);
  EXPECT_NEAR(other.world().joints().velocity(other.world().tree().find("/pointer")), 2, 2e-3);
  EXPECT_TRUE(other.save() == simulation.save());
}

TEST(Snapshot, IsWhatAResetGoesBackTo) {
  const auto scene = std::make_shared<const Scene>(heap());
  Simulation simulation(scene, 3);
  const std::string start = simulation.save();
  const std::vector<std::string> expected = run(simulation, 0, 40);
  simulation.reset();
  EXPECT_TRUE(simulation.save() == start);
  expect_equal(run(simulation, 0, 40), expected, "after a reset");
}

TEST(Snapshot, RemovesModelsThatWereAddedSince) {
  Simulation simulation(scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 2))}));
  run(simulation, 0, 3);
  const std::string saved = simulation.save();
  const std::vector<std::string> expected = run(simulation, 3, 9);
  simulation.add_model(model("Other", link_with(Sphere{0.5}), at(0, 0, 4)));
  run(simulation, 9, 12);
  simulation.restore(saved);
  expect_equal(run(simulation, 3, 9), expected, "without the model");
}

/// A change of what is saved needs another version, in simulation_snapshot.cpp; then this number changes too.
TEST(Snapshot, HasTheSizeOfItsVersion) {
  Simulation simulation(scene({floor(), model("Box", link_with(Box{{1, 1, 1}}), at(0, 0, 2))}));
  const std::string saved = simulation.save();
  EXPECT_EQ(static_cast<int>(saved[16]), 10) << "version";
  EXPECT_EQ(saved.size(), 867U) << "bytes";
}

}  // namespace
}  // namespace bubblesim::test::test_snapshot
