// SPDX-License-Identifier: BSD-3-Clause
// Scenes that include models: search paths, and elements of an <include>.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_model_includes {
namespace {

const std::string kModel =
    "<sdf version='1.9' xmlns:bubblesim='https://bubblesim'><model name='robot'>"
    "<bubblesim:child_script>own.py</bubblesim:child_script><link name='base'/></model></sdf>";

/// A scene, and a model in a folder of the given name next to it.
class ModelIncludes : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("bubblesim_includes_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    ::unsetenv("BUBBLESIM_MODEL_PATH");
    ::unsetenv("GAZEBO_MODEL_PATH");
    fs::remove_all(folder_);
  }

  fs::path write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
    return folder_ / file;
  }

  void write_model(const fs::path& folder) const {
    write(folder / "model.config", "<model><name>robot</name><sdf version='1.9'>model.sdf</sdf></model>");
    write(folder / "model.sdf", kModel);
    write(folder / "own.py", "");
  }

  SceneDescription load(const std::string& includes, std::vector<Problem>* warnings = nullptr) const {
    return read_scene(write("scene/scene.sdf", in_world(includes)).string(), {}, warnings);
  }

  std::string reported_for(const std::string& includes) const {
    try {
      load(includes);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(ModelIncludes, AreFoundBesideTheScene) {
  write_model("scene/near");
  write_model("scene/models/shared");
  const SceneDescription scene = load(
      "<include><uri>near</uri><name>A</name></include>"
      "<include><uri>model://shared</uri><name>B</name><pose>1 2 3 0 0 0</pose></include>");
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.models[0].name, "A");
  EXPECT_EQ(scene.models[1].name, "B");
  EXPECT_EQ(scene.models[1].pose.position, Vector3(1, 2, 3));
}

TEST_F(ModelIncludes, AreFoundInTheFoldersOfTheEnvironment) {
  write_model("ours/one");
  write_model("gazebos/two");
  ::setenv("BUBBLESIM_MODEL_PATH", ("/nowhere:" + (folder_ / "ours").string()).c_str(), 1);
  ::setenv("GAZEBO_MODEL_PATH", (folder_ / "gazebos").c_str(), 1);
  EXPECT_EQ(load("<include><uri>model://one</uri></include>").models.size(), 1u);
  EXPECT_EQ(load("<include><uri>model://two</uri></include>").models.size(), 1u);
}

TEST_F(ModelIncludes, AreFoundByAFilesPath) {
  write_model("anywhere");
  const std::string uri = "file://" + (folder_ / "anywhere" / "model.sdf").string();
  EXPECT_EQ(load("<include><uri>" + uri + "</uri></include>").models.size(), 1u);
}

TEST_F(ModelIncludes, OfTheShippedModelsNeedNoFolder) {
  EXPECT_EQ(load("<include><uri>model://tricycle</uri></include>").models.at(0).name, "Tricycle");
}

TEST_F(ModelIncludes, KeepTheScriptBesideTheModel) {
  write_model("scene/near");
  const SceneDescription scene = load("<include><uri>near</uri></include>");
  EXPECT_TRUE(fs::equivalent(scene.models.at(0).child_script, folder_ / "scene/near/own.py"));
}

TEST_F(ModelIncludes, MayGiveAnotherScriptBesideTheScene) {
  write_model("scene/near");
  write("scene/other.py", "");
  const SceneDescription scene =
      load("<include><uri>near</uri><bubblesim:child_script>other.py</bubblesim:child_script></include>");
  EXPECT_TRUE(fs::equivalent(scene.models.at(0).child_script, folder_ / "scene/other.py"));
}

TEST_F(ModelIncludes, OfAScriptThatDoesNotExistIsReportedWithItsLine) {
  write_model("scene/near");
  const std::string reported =
      reported_for("\n<include><uri>near</uri><bubblesim:child_script>none.py</bubblesim:child_script></include>");
  EXPECT_NE(reported.find("scene.sdf:2"), std::string::npos) << reported;
  EXPECT_NE(reported.find("none.py does not exist"), std::string::npos) << reported;
}

TEST_F(ModelIncludes, OfUnknownModelsAreLeftOutAndNameWhereWasSearched) {
  std::vector<Problem> warnings;
  EXPECT_TRUE(load("\n<include><uri>model://nothing</uri></include>", &warnings).models.empty());
  const std::string reported = lines_of(warnings);
  EXPECT_NE(reported.find("scene.sdf:2: model not found: 'model://nothing', ignored"), std::string::npos) << reported;
  EXPECT_NE(reported.find((folder_ / "scene" / "models").string()), std::string::npos) << reported;
  EXPECT_NE(reported.find("BUBBLESIM_MODEL_PATH"), std::string::npos) << reported;
}

TEST_F(ModelIncludes, OfMistypedModelsNameSimilarOnes) {
  write_model("scene/models/shelf");
  std::vector<Problem> warnings;
  load("<include><uri>model://shelv</uri></include>", &warnings);
  EXPECT_NE(lines_of(warnings).find("'model://shelv', ignored; did you mean shelf? (searched in"), std::string::npos);
}

TEST_F(ModelIncludes, ProblemsInsideAModelAreReportedInItsFile) {
  write_model("scene/near");
  write("scene/near/model.sdf",
        "<sdf version='1.9'><model name='robot'><link name='base'><inertial><mass>-1</mass></inertial>\n"
        "</link></model></sdf>");
  EXPECT_NE(reported_for("<include><uri>near</uri></include>").find("near/model.sdf:1"), std::string::npos);
}

/// Two objects with places: a base and, below it, a tip.
const std::string kModelWithPlaces =
    "<sdf version='1.9' xmlns:bubblesim='https://bubblesim'><model name='arm'>"
    "<bubblesim:is_object>false</bubblesim:is_object><link name='base'><bubblesim:alias>Arm</bubblesim:alias>"
    "<bubblesim:place><id>5</id></bubblesim:place></link><bubblesim:object "
    "name='tip'><kind>dummy</kind><link>base</link>"
    "<bubblesim:place><id>7</id><parent>5</parent></bubblesim:place></bubblesim:object></model></sdf>";

TEST_F(ModelIncludes, OfOneModelWithPlacesHaveATreeEach) {
  write("scene/arm.sdf", kModelWithPlaces);
  const SceneDescription scene = load(
      "<include><uri>arm.sdf</uri><name>left</name></include><include><uri>arm.sdf</uri><name>right</name></include>"
      "<bubblesim:object "
      "name='mark'><kind>dummy</kind><bubblesim:place><id>8</id></bubblesim:place></bubblesim:object>");
  ASSERT_EQ(scene.models.size(), 2u);
  const auto base = [&](int i) { return *scene.models[i].links[0].place; };
  const auto tip = [&](int i) { return *scene.models[i].frames[0].place; };
  EXPECT_EQ(tip(0).parent, base(0).id);
  EXPECT_EQ(tip(1).parent, base(1).id);
  EXPECT_EQ(base(0).parent, -1);
  EXPECT_EQ(base(1).parent, -1);
  EXPECT_EQ((std::set<int>{base(0).id, tip(0).id, base(1).id, tip(1).id, 8}).size(), 5u);
}

TEST_F(ModelIncludes, GiveNameAndScriptOfAModelThatIsNoObjectToItsBase) {
  write("scene/arm.sdf", kModelWithPlaces);
  write("scene/move.py", "");
  const SceneDescription scene = load(
      "<include><uri>arm.sdf</uri><name>left</name>"
      "<bubblesim:child_script>move.py</bubblesim:child_script></include>");
  const LinkDescription& base = scene.models[0].links[0];
  EXPECT_EQ(base.alias, "left");
  EXPECT_EQ(base.place->child_script.filename(), "move.py");
  EXPECT_TRUE(scene.models[0].child_script.empty());
  EXPECT_TRUE(scene.models[0].frames[0].alias.empty());
}

}  // namespace
}  // namespace bubblesim::test::test_model_includes
