// SPDX-License-Identifier: BSD-3-Clause
// <bubblesim:substeps>, and the warning of models that need more.
#include <gtest/gtest.h>

#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_substeps {
namespace {

/// Three rods of 1 m below each other; the last weighs `load` kg.
std::string chain(const std::string& substeps, const std::string& load) {
  std::string text =
      "<physics type='ode'><max_step_size>0.005</max_step_size>" + substeps + "</physics><model name='C'>";
  for (int i = 0; i < 3; ++i) {
    const std::string name = "rod" + std::to_string(i);
    text += "<link name='" + name + "'><pose>0 0 -" + std::to_string(i) + " 0 0 0</pose><inertial><mass>" +
            (i == 2 ? load : "1") +
            "</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>" +
            "<joint name='j" + std::to_string(i) + "' type='revolute'><parent>" +
            (i == 0 ? "world" : "rod" + std::to_string(i - 1)) + "</parent><child>" + name +
            "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  }
  return in_world(text + "</model>");
}

TEST(Substeps, DivideThePhysicsStep) {
  const TemporaryFile file("number.sdf", chain("<bubblesim:substeps>4</bubblesim:substeps>", "1"));
  EXPECT_DOUBLE_EQ(read_scene(file.path()).substep, 0.00125);
}

TEST(Substeps, AutoTakesAsManyAsTheModelsNeed) {
  const std::string automatic = "<bubblesim:substeps>auto</bubblesim:substeps>";
  const TemporaryFile file("light.sdf", chain(automatic, "1"));
  EXPECT_DOUBLE_EQ(read_scene(file.path()).substep, 0.005);
  const TemporaryFile heavy("heavy.sdf", chain(automatic, "2000"));
  // 2 / sqrt(3 T d / I) = 2.6 ms
  EXPECT_DOUBLE_EQ(read_scene(heavy.path()).substep, 0.0025);
}

TEST(Substeps, ChainThatNeedsMoreIsWarnedOf) {
  const TemporaryFile file("heavy.sdf", chain("", "2000"));
  std::vector<Problem> warnings;
  read_scene(file.path(), {}, &warnings);
  EXPECT_NE(lines_of(warnings).find("rod0: carries 2001 kg between its joints"), std::string::npos)
      << lines_of(warnings);
  EXPECT_NE(lines_of(warnings).find("set <bubblesim:substeps> to auto"), std::string::npos);
}

TEST(Substeps, OtherTextIsAnError) {
  for (const char* text : {"many", "0", "1.5"}) {
    const TemporaryFile file("bad.sdf",
                             chain("<bubblesim:substeps>" + std::string(text) + "</bubblesim:substeps>", "1"));
    EXPECT_THROW(read_scene(file.path()), SceneError) << text;
  }
}

}  // namespace
}  // namespace bubblesim::test::test_substeps
