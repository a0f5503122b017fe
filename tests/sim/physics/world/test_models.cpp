// SPDX-License-Identifier: BSD-3-Clause
// Adding models to a running world and removing them.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <thread>

#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_models {
namespace {

ModelDescription box(const std::string& name, const Pose& pose) {
  return model(name, link_with(Box{{0.5, 0.4, 0.3}}), pose);
}

/// Falls onto the floor and over each other.
std::vector<ModelDescription> heap() {
  return {floor(), box("Box0", Pose(0, 0, 0.5, 0.3, 0.2, 0)), box("Box1", Pose(0.1, 0, 1, 0.6, 0.2, 0))};
}

/// Two links with a joint of each kind of ODE handle, a sonar and a shape.
ModelDescription robot(const Pose& pose) {
  AxisDescription limited = axis(Vector3::UnitZ(), MotorMode::kVelocity);
  limited.lower = -1;
  limited.upper = 1;
  ModelDescription described = model("Robot", link("base"), pose);
  described.links.push_back(link("arm", {1, 0, 0}));
  described.links[0].collisions.push_back(shape(Sphere{0.2}));
  described.joints.push_back(joint("revolute", {limited}));
  SensorDescription sonar;
  sonar.name = "Sonar";
  sonar.kind = SonarDescription{0, 10, 0};
  described.links[0].sensors.push_back(sonar);
  return described;
}

std::vector<std::uint64_t> history(Simulation& simulation, int steps = 30) {
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    hashes.push_back(simulation.state_hash());
  }
  return hashes;
}

/// The text of the error that an action throws.
template <class Error>
std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(AddedModel, TakesPartAsIfItHadBeenThereFromTheStart) {
  for (const bool is_static : {false, true}) {
    ModelDescription late = box("Late", Pose(0.2, 0.1, 0.2, 0, 0, 0.3));
    late.is_static = is_static;
    std::vector<ModelDescription> all = heap();
    all.push_back(late);
    Simulation expected(scene(all));
    Simulation simulation(scene(heap()));
    simulation.add_model(late);
    EXPECT_EQ(history(simulation), history(expected)) << is_static;
  }
}

TEST(AddedModel, IsStoodUpon) {
  for (const double x : {0.0, 500.0}) {  // inside and outside the extent of the existing models
    World world(scene({floor(), model("Ball", link_with(Sphere{0.1}), at(x, 0, 2))}), 0);
    world.advance(0.1, 0.005);
    world.models().add(still(model("Table", link_with(Box{{1, 1, 1}}), at(x, 0, 0.5))));
    world.advance(3, 0.005);
    EXPECT_NEAR(world.pose(world.tree().find("/Ball")).position.z(), 1.1, 0.003) << x;
  }
}

TEST(AddedModel, BringsItsObjects) {
  Simulation simulation(scene(heap()));
  simulation.step();
  const ObjectId id = simulation.add_model(robot(at(5, 6, 7)));
  const World& world = simulation.world();
  EXPECT_EQ(world.tree().path(id), "/Robot");
  EXPECT_EQ(world.pose(world.tree().find("/Robot/arm")).position, Vector3(6, 6, 7));
  simulation.world().joints().set_target_velocity(world.tree().find("/Robot/joint"), 0.5);
  const ObjectId sonar = world.tree().find("/Robot/Sonar");
  EXPECT_FALSE(simulation.read_proximity(sonar).detected);
  simulation.add_model(still(model("Wall", link_with(Box{{1, 50, 50}}), at(9.5, 6, 7))));
  simulation.step();
  EXPECT_NEAR(simulation.read_proximity(sonar).distance, 4, 0.05) << "it fell a little";
  EXPECT_GT(world.joints().velocity(world.tree().find("/Robot/joint")), 0.4);
}

TEST(AddedModel, ThatIsBadIsRefusedAndChangesNothing) {
  struct Case {
    std::function<void(ModelDescription&)> spoil;
    std::string text;
  };
  const std::vector<Case> cases = {
      {[](auto& m) { m.pose.position.x() = kNaN; }, "/Robot: the position is (nan, 6, 7)"},
      {[](auto& m) { m.pose.position.x() = 1e300; }, "/Robot: the position is (1e+300, 6, 7)"},
      {[](auto& m) { m.pose.orientation = Quaternion(0, 0, 0, 0); },
       "/Robot: the orientation (x, y, z, w) is (0, 0, 0, 0)"},
      {[](auto& m) { m.links[1].mass = 0; }, "/Robot/arm: the mass is 0 kg"},
      {[](auto& m) { m.links[1].inertia_diagonal.x() = -1; }, "/Robot/arm: the inertia is"},
      {[](auto& m) { m.links.clear(); }, "/Robot: has no link"},
      {[](auto& m) { m.joints[0].child = "amr"; }, "did you mean arm"},
      {[](auto& m) { m.name = "Box0"; }, "/Box0: a model with this name exists already"},
      {[](auto& m) { m.name = ""; }, "the model has no name"},
      {[](auto& m) { m.name = "a/b"; }, "the name contains '/'"},
  };
  Simulation simulation(scene(heap()));
  simulation.step();
  const std::uint64_t before = simulation.state_hash();
  const std::size_t objects = simulation.world().tree().size();
  for (const Case& bad : cases) {
    ModelDescription described = robot(at(5, 6, 7));
    bad.spoil(described);
    const std::string error = error_of<SceneError>([&] { simulation.add_model(described); });
    EXPECT_NE(error.find(bad.text), std::string::npos) << error;
  }
  EXPECT_EQ(simulation.state_hash(), before);
  EXPECT_EQ(simulation.world().tree().size(), objects);
  Simulation untouched(scene(heap()));
  untouched.step();
  EXPECT_EQ(history(simulation), history(untouched));
}

TEST(RemovedModel, LeavesAWorldWithoutIt) {
  Simulation simulation(scene({floor(), still(model("Table", link_with(Box{{1, 1, 1}}), at(0, 0, 0.5))),
                               model("Ball", link_with(Sphere{0.1}), at(0, 0, 1.1))}));
  for (int i = 0; i < 10; ++i) simulation.step();
  simulation.remove_model(simulation.world().tree().find("/Table"));
  for (int i = 0; i < 40; ++i) simulation.step();
  EXPECT_NEAR(simulation.world().pose(simulation.world().tree().find("/Ball")).position.z(), 0.1, 0.003);
  EXPECT_FALSE(simulation.world().geometry().cast_ray({0, 0, 5}, {0, 0, -1}, 4.5));
}

TEST(RemovedModel, WhoseContactsHeldOthersLetsThemFall) {
  Simulation simulation(scene({floor(), model("Below", link_with(Box{{1, 1, 1}}), at(0, 0, 0.5)),
                               model("Above", link_with(Sphere{0.1}), at(0, 0, 1.1))}));
  for (int i = 0; i < 10; ++i) simulation.step();
  simulation.remove_model(simulation.world().tree().find("/Below"));
  for (int i = 0; i < 40; ++i) simulation.step();
  EXPECT_NEAR(simulation.world().pose(simulation.world().tree().find("/Above")).position.z(), 0.1, 0.003);
}

TEST(RemovedModel, ThatCameBeforeLeavesNoTrace) {
  Simulation expected(scene(heap()));
  Simulation simulation(scene(heap()));
  simulation.remove_model(simulation.add_model(robot(at(5, 0, 2))));
  EXPECT_EQ(history(simulation), history(expected));
}

TEST(RemovedModel, HasHandlesThatNameNothingAnyMore) {
  Simulation simulation(scene(heap()));
  const ObjectId first = simulation.add_model(robot(at(5, 6, 7)));
  const ObjectId sonar = simulation.world().tree().find("/Robot/Sonar");
  const ObjectId other = simulation.world().tree().find("/Box0");
  simulation.remove_model(first);
  const ObjectId second = simulation.add_model(robot(at(5, 6, 7)));
  EXPECT_GT(second, sonar) << "handles are not reused";
  EXPECT_EQ(simulation.world().tree().at(other).name, "Box0");
  EXPECT_NE(error_of<NoSuchObject>([&] { simulation.world().pose(first); }).find("was removed"), std::string::npos);
  EXPECT_NE(error_of<NoSuchObject>([&] { simulation.read_proximity(sonar); }).find("was removed"), std::string::npos);
  EXPECT_THROW(simulation.remove_model(first), NoSuchObject);
}

TEST(RemovingAnObject, ThatIsNoModelIsRefused) {
  Simulation simulation(scene(heap()));
  simulation.add_model(robot(at(5, 6, 7)));
  const std::uint64_t before = simulation.state_hash();
  for (const char* path : {"/Robot/arm", "/Robot/joint", "/Robot/Sonar"}) {
    const ObjectId id = simulation.world().tree().find(path);
    EXPECT_NE(error_of<WrongObject>([&] { simulation.remove_model(id); }).find("cannot be removed on its own"),
              std::string::npos);
  }
  EXPECT_EQ(simulation.state_hash(), before);
}

TEST(ManyModels, MayComeAndGo) {
  Simulation simulation(scene(heap()));
  for (int i = 0; i < 100; ++i) {
    const ObjectId id = simulation.add_model(robot(at(0, 0, 1.5)));
    const ObjectId post = simulation.add_model(still(box("Post", at(1, 0, 0.1))));
    simulation.step();
    simulation.remove_model(post);
    simulation.step();
    simulation.remove_model(id);
  }
  EXPECT_EQ(simulation.world().tree().models().size(), 3u);
}

TEST(Reset, PutsTheModelsThatAreThereBackToWhereTheyCame) {
  Simulation simulation(scene(heap()));
  simulation.step();
  const ObjectId added = simulation.add_model(robot(at(5, 6, 7)));
  simulation.remove_model(simulation.world().tree().find("/Box0"));
  history(simulation);
  simulation.reset();
  EXPECT_EQ(simulation.world().pose(added), at(5, 6, 7));
  EXPECT_THROW(simulation.world().tree().find("/Box0"), NoSuchObject);
  Simulation expected(scene({heap()[0], heap()[2], robot(at(5, 6, 7))}));
  EXPECT_EQ(history(simulation), history(expected));
}

TEST(Reset, AfterStaticModelsCameAndWentEqualsANewSimulation) {
  const auto post = [](const std::string& name, double x) { return still(box(name, at(x, 0, 0.1))); };
  std::vector<ModelDescription> models = heap();
  models.push_back(post("First", 1));
  models.push_back(post("Second", 200));  // removed: the others take less space
  Simulation simulation(scene(models));
  history(simulation);
  simulation.remove_model(simulation.world().tree().find("/Second"));
  simulation.add_model(post("Third", -1));
  history(simulation);
  simulation.reset();
  models[models.size() - 1] = post("Third", -1);
  Simulation expected(scene(models));
  EXPECT_EQ(history(simulation), history(expected));
  simulation.reset();  // nothing came or went since
  Simulation again(scene(models));
  EXPECT_EQ(history(simulation), history(again));
}

TEST(DivergedWorld, IsResetBeforeModelsComeOrGo) {
  Simulation simulation(
      scene({model("Ball", link("link"), at(999999, 0, 0)), model("Other", link("link"))}, {1e4, 0, 0}));
  EXPECT_THROW(history(simulation, 100), Diverged);
  const ObjectId ball = simulation.world().tree().find("/Ball");
  EXPECT_THROW(simulation.add_model(robot({})), Diverged);
  EXPECT_THROW(simulation.remove_model(simulation.world().tree().find("/Other")), Diverged);
  simulation.reset();
  simulation.remove_model(ball);
  simulation.add_model(robot({}));
  simulation.step();
}

TEST(DivergedWorld, GoesOnWithoutWhatDiverged) {
  Simulation simulation(
      scene({model("Ball", link("link"), at(999999, 0, 0)), model("Other", link("link"))}, {1e4, 0, 0}));
  EXPECT_THROW(history(simulation, 100), Diverged);
  simulation.remove_model(simulation.world().tree().find("/Ball"));
  EXPECT_NO_THROW(simulation.step());
}

/// Records the models of its calls, and adds or removes one on request.
struct Watcher : System {
  explicit Watcher(Simulation& s) : simulation(s) { s.add(*this); }

  void process_input() override {
    if (on_drain) on_drain();
  }
  void actuate(World&, double) override {
    if (on_actuate) on_actuate();
  }
  void sense(const World&, double) override {
    if (on_sense) on_sense();
  }
  void model_added(World& world, ObjectId model) override { reported.push_back("+" + world.tree().path(model)); }
  void model_removing(World& world, ObjectId model) override {
    reported.push_back("-" + world.tree().path(model));
    world.pose(model);  // still exists
  }

  Simulation& simulation;
  std::function<void()> on_drain;
  std::function<void()> on_actuate;
  std::function<void()> on_sense;
  std::vector<std::string> reported;
};

TEST(Systems, AreNotifiedOfModelsThatAreAddedAndRemoved) {
  Simulation simulation(scene(heap()));
  Watcher watcher(simulation);
  simulation.remove_model(simulation.add_model(robot({})));
  EXPECT_THROW(simulation.add_model(box("Box0", {})), SceneError);
  EXPECT_THROW(simulation.remove_model(simulation.world().tree().find("/Box0/link")), InvalidInput);
  EXPECT_EQ(watcher.reported, (std::vector<std::string>{"+/Robot", "-/Robot"}));
}

TEST(Models, ComeAndGoBeforeThePhysicsOfAStepButNotAfter) {
  Simulation simulation(scene(heap()));
  Watcher watcher(simulation);
  ObjectId drained = kNoObject;
  ObjectId actuated = kNoObject;
  watcher.on_drain = [&] { drained = simulation.add_model(robot({})); };
  watcher.on_actuate = [&] {
    actuated = simulation.add_model(box("Other", {}));
    simulation.remove_model(drained);
    EXPECT_THROW(simulation.reset(), std::logic_error);
  };
  watcher.on_sense = [&] {
    EXPECT_THROW(simulation.add_model(box("Third", {})), std::logic_error);
    EXPECT_THROW(simulation.remove_model(actuated), std::logic_error);
  };
  simulation.step();
  EXPECT_EQ(simulation.world().tree().path(actuated), "/Other");
  EXPECT_EQ(watcher.reported, (std::vector<std::string>{"+/Robot", "+/Other", "-/Robot"}));
}

TEST(Models, ComeAndGoInTheThreadThatStandsInForTheSteppingOne) {
  Simulation simulation(scene(heap()));
  Watcher watcher(simulation);
  watcher.on_actuate = [&] {
    const AccessLock::Pause others_may_look(simulation.world().access());  // as around a call of Python
    std::thread([&] {
      EXPECT_THROW(simulation.add_model(robot({})), std::logic_error);
      const Simulation::StandIn stand_in(simulation);
      EXPECT_NO_THROW(simulation.add_model(robot({})));
    }).join();
  };
  simulation.step();
  EXPECT_EQ(watcher.reported, (std::vector<std::string>{"+/Robot"}));
}

}  // namespace
}  // namespace bubblesim::test::test_models
