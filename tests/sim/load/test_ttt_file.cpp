// SPDX-License-Identifier: BSD-3-Clause
// Files of CoppeliaSim: the container, lists of tags, values, and files that are damaged.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "load/ttt/bytes.hpp"
#include "load/ttt/container.hpp"
#include "load/ttt/huffman.hpp"
#include "load/ttt/read_objects.hpp"
#include "load/ttt/scene_file.hpp"
#include "load/ttt/structure.hpp"
#include "load/ttt/tag_list.hpp"
#include "ttt_writer.hpp"

namespace bubblesim::test::test_ttt_file {
namespace {

using namespace bubblesim::ttt;
using namespace ttt_writer;
namespace fs = std::filesystem;

std::string problem(const std::string& bytes) {
  try {
    structure_of(read_scene_file(bytes));
  } catch (const FormatError& error) {
    return error.what();
  }
  return "it is read";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Bits as text, filled up with zeros.
std::string bits(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 8) {
    unsigned value = 0;
    for (std::size_t j = i; j < i + 8; ++j) value = value << 1U | (j < text.size() && text[j] == '1' ? 1U : 0U);
    bytes += static_cast<char>(value);
  }
  return bytes;
}

const std::string kLetterA = "101000001";  // a leaf with the value 65
const std::string kLetterB = "101000010";

TEST(TttHuffman, DecodesATreeInPreorderAndItsCodes) {
  EXPECT_EQ(unpack(bits("0" + kLetterA + kLetterB + "0110"), 4, 0), "ABBA");
}

TEST(TttHuffman, RepeatsTheOnlyLeaf) { EXPECT_EQ(unpack(bits(kLetterA + "000"), 3, 0), "AAA"); }

TEST(TttHuffman, ReportsBitsThatEndEarlyAndTreesThatAreTooLarge) {
  EXPECT_THROW(unpack(bits("0" + kLetterA + kLetterB), 100, 0), FormatError);
  EXPECT_THROW(unpack(std::string(1000, '\0'), 1, 0), FormatError);
  EXPECT_THROW(unpack("", 1, 0), FormatError);
}

TEST(TttContainer, NamesWhatIsNoSuchFile) {
  EXPECT_TRUE(holds(problem(""), "empty"));
  EXPECT_TRUE(holds(problem("version https://git-lfs.github.com/spec/v1"), "Git LFS"));
  EXPECT_TRUE(holds(problem("<sdf/>"), "does not begin with VREP"));
  EXPECT_TRUE(holds(problem("VREP"), "cut off"));
  EXPECT_TRUE(holds(problem(header(0, 3, 12) + "EOF"), "version 12"));
  EXPECT_TRUE(holds(problem(header(9, 3) + "EOF"), "compression 9"));
}

TEST(TttContainer, RefusesSizesThatCannotBeBeforeItAllocates) {
  EXPECT_TRUE(holds(problem(header(1, 25) + "EOF"), "at byte 13"));  // more than 8 times the payload
  EXPECT_TRUE(holds(problem(header(0, 4) + "EOF"), "at byte 13"));
  EXPECT_TRUE(holds(problem(header(1, std::size_t{0xffffffff}) + "EOF"), "at byte 13"));
}

TEST(TttTagList, SkipsItemsThatItDoesNotKnowAndEndsAtTheMarker) {
  const std::string content = item("Xyz", "anything") + item("Num", ints({7})) + "EOO" + item("Two", ints({8})) + "EOO";
  Bytes bytes(content);
  const TagList first(bytes);
  const TagList second(bytes);
  EXPECT_EQ(first.integer("Num"), 7);
  EXPECT_FALSE(first.has("Two"));
  EXPECT_EQ(second.integer("Two"), 8);
}

TEST(TttTagList, PrefersDoubles) {
  const std::string content = item("Mas", floats({1})) + item("_as", doubles({2}));
  Bytes bytes(content);
  EXPECT_EQ(TagList(bytes).number("Mas", "_as"), 2);
}

TEST(TttTagList, RefusesLengthsBeyondTheEnclosingItem) {
  EXPECT_TRUE(holds(problem(header(0, 10) + "SHP" + ints({100}) + "EOF"), "do not fit"));
  EXPECT_TRUE(holds(problem(header(0, 10) + "SHP" + ints({-1}) + "EOF"), "do not fit"));
}

TEST(TttFile, ReadsWhatObjectsHaveInCommon) {
  const SceneFile scene = read_scene_file(
      file({{"DMY", 5, 3, "Goal", {0, 0, 0, 2, 1, 2, 3}, item("Va3", byte(1)) + item("Cor", ints({4})), ""}}));
  ASSERT_EQ(scene.objects.size(), 1U);
  const Object& goal = scene.objects[0];
  EXPECT_TRUE(scene.is_scene);
  EXPECT_EQ(goal.handle, 5);
  EXPECT_EQ(goal.parent, 3);
  EXPECT_EQ(goal.alias, "Goal");
  EXPECT_TRUE(goal.is_model);
  EXPECT_EQ(goal.order, 4);
  EXPECT_EQ(goal.pose.position, Vector3(1, 2, 3));
  EXPECT_EQ(goal.pose.orientation.z(), 1);  // normalized
}

TEST(TttFile, TakesTheAliasFromTheOldName) {
  const std::string object = item("Ids", ints({0, -1})) + item("Nme", text("wheel#0")) + "NXTEOO";
  const std::string content = item("DMY", object) + "EOF";
  EXPECT_EQ(read_scene_file(header(0, content.size(), 22) + content).objects.at(0).alias, "wheel");
}

TEST(TttFile, ReadsFormatsOfLaterVersions) {
  const std::string content = ObjectText{"DMY", 1, -1, "goal"}.bytes() + "EOF";
  const SceneFile scene = read_scene_file(header(0, content.size(), 27) + content);
  EXPECT_EQ(scene.objects.size(), 1U);
  ASSERT_EQ(scene.left_out.size(), 1U);
  EXPECT_TRUE(holds(scene.left_out.begin()->first, "later version (27)"));
}

TEST(TttFile, ScriptObjectsActForTheirParent) {
  const auto script = [](unsigned bits) {
    return item("Soo", item("Si2", ints({0, 8, 1})) + item("Va3", byte(bits)) + item("Ste", "--") + "EOO");
  };
  const SceneFile scene = read_scene_file(file({{"DMY", 7, -1, "robot"},
                                                {"SCT", 8, 7, "Script", {1, 0, 0, 0, 0, 0, 0}, "", script(1)},
                                                {"SCT", 9, 7, "old", {1, 0, 0, 0, 0, 0, 0}, "", script(5)}}));
  ASSERT_EQ(scene.scripts.size(), 2U);
  EXPECT_EQ(scene.scripts[0].object, 7);
  EXPECT_EQ(scene.scripts[0].holder, 8);   // '.' leads there, '..' to the robot
  EXPECT_EQ(scene.scripts[1].holder, -1);  // '.' leads to the robot
}

TEST(TttFile, ReadsTheMassAndTheInertiaAboutTheCentreOfMass) {
  const SceneFile scene = read_scene_file(file({{"SHP", 1, -1, "box", {1, 0, 0, 0, 0, 0, 0}, "", cuboid(kDynamic)}}));
  const Shape* shape = scene.objects.at(0).as<Shape>();
  ASSERT_NE(shape, nullptr);
  EXPECT_FALSE(shape->is_static);
  EXPECT_TRUE(shape->is_respondable);
  EXPECT_EQ(shape->mass, 2);
  EXPECT_EQ(shape->inertia, Matrix3::Identity());
  ASSERT_EQ(shape->parts.size(), 1U);
  EXPECT_EQ(shape->parts[0].primitive, PrimitiveKind::kCuboid);
}

TEST(TttFile, TurnsOldMomentsOfInertiaToTheAxesOfTheShape) {
  // The frame of the moments is turned by 90 degrees about z: its x axis is the shape's y axis.
  const float half = std::sqrt(0.5F);
  const std::string body = item("Mas", floats({3})) + item("Ine", floats({0, 0, 1, half, 0, 0, half, 1, 2, 3}));
  const std::string own = item("Ge2", item("Gst", body + "EOO" + "EOO") + "EOO");
  const SceneFile scene = read_scene_file(file({{"SHP", 1, -1, "old", {1, 0, 0, 0, 0, 0, 0}, "", own}}));
  const Shape& shape = *scene.objects.at(0).as<Shape>();
  EXPECT_EQ(shape.centre_of_mass, Vector3(0, 0, 1));
  EXPECT_NEAR(shape.inertia(0, 0), 2, 1e-6);
  EXPECT_NEAR(shape.inertia(1, 1), 1, 1e-6);
  EXPECT_NEAR(shape.inertia(2, 2), 3, 1e-6);
}

TEST(TttFile, UnpacksIndicesAsDifferences) {
  // 0, 1, 2 in one byte each: the difference plus 31. Then 2000, which is 1998 more, in two bytes: 1998 + 8191 = 10189.
  const std::string packed = ints({3}) + byte(31) + byte(32) + byte(0x40U | (10190U & 0x3fU)) + byte(10190U >> 6U);
  MeshData meshes;
  const std::string list = item("In2", packed);
  Bytes bytes(list);
  meshes.add(TagList(bytes));
  const Triangles& triangles = *meshes.triangles.at(0);
  ASSERT_EQ(triangles.size(), 1U);
  EXPECT_EQ(triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2000}));
}

TEST(TttFile, ReadsJointsOfOldFilesByTheirMotorBits) {
  const auto control = [](unsigned motor_bits) {
    const std::string list = item("Jtt", ints({10})) + item("Va9", byte(motor_bits));
    Bytes bytes(list);
    return read_joint(TagList(bytes)).control;
  };
  EXPECT_EQ(control(0), JointControl::kFree);
  EXPECT_EQ(control(0x10), JointControl::kVelocity);
  EXPECT_EQ(control(0x30), JointControl::kPosition);
  EXPECT_EQ(control(0xb0), JointControl::kSpring);
}

TEST(TttFile, ReadsTheUpperLimitOfAJointAsARange) {
  const std::string list = joint(5, 0.25);
  Bytes bytes(list);
  const Joint read = read_joint(TagList(bytes));
  EXPECT_EQ(read.lower, -1);
  EXPECT_EQ(read.upper, 1);
  EXPECT_EQ(read.position, 0.25);
  EXPECT_TRUE(read.is_dynamic);
}

TEST(TttFile, HoldsAJointWithANegativeRangeAtItsSmallestPosition) {
  const std::string list = item("_mr", doubles({0.5, -1}));
  Bytes bytes(list);
  const Joint read = read_joint(TagList(bytes));
  EXPECT_EQ(read.lower, 0.5);
  EXPECT_EQ(read.upper, 0.5);
}

TEST(TttFile, TurnsAScrewWithALeadThatCannotBeOnTheSpot) {
  for (const double lead : {1e-40, 1e20, -1e20}) {
    const std::string list = item("Sld", doubles({lead}));
    Bytes bytes(list);
    EXPECT_EQ(read_joint(TagList(bytes)).lead, 0);
  }
}

TEST(TttFile, ReadsTheTextOfScripts) {
  // By the rule of the format: F = 'a', L = 'd', s = 48, e = 300; b[1] += 1 + s + e, b[2] -= 3 * 2 + s.
  std::string obscured = "abcd";
  obscured[1] = static_cast<char>('b' - (1 + 48 + 300));
  obscured[2] = static_cast<char>('c' + (6 + 48));
  EXPECT_EQ(clear_text(obscured), "abcd");
  EXPECT_EQ(clear_text(std::string("ab")), "ab");
}

TEST(TttFile, KnowsPythonByItsFirstLines) {
  const auto is_python = [](const std::string& script) {
    const std::string list = item("Ste", script);  // of two bytes or less: plain
    Bytes bytes(list);
    return read_script(TagList(bytes)).is_python;
  };
  EXPECT_FALSE(is_python("--"));
  const std::string list = item("Ste", "--") + item("Lne", text("python"));
  Bytes bytes(list);
  EXPECT_TRUE(read_script(TagList(bytes)).is_python);
}

/// Public files, if there are any beside the project.
std::vector<fs::path> public_files() {
  std::vector<fs::path> files;
  // The folder of the sources may consist of links.
  const fs::path root = fs::canonical(fs::path(BUBBLESIM_ROOT) / "CMakeLists.txt").parent_path();
  const fs::path folder = root.parent_path() / "shared" / "ttt";
  const fs::path above = root.parent_path().parent_path() / "shared" / "ttt";
  for (const fs::path& place : {folder, above}) {
    if (!fs::is_directory(place)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(place)) {
      if (entry.path().extension() == ".ttt" || entry.path().extension() == ".ttm") files.push_back(entry.path());
    }
    break;
  }
  return files;
}

std::string content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

TEST(TttFile, ReadsAllPublicFiles) {
  const auto files = public_files();
  if (files.empty()) GTEST_SKIP() << "no public files beside the project";
  for (const fs::path& path : files) {
    const std::string bytes = content(path);
    EXPECT_TRUE(bytes.empty() || problem(bytes) == "it is read") << path << problem(bytes);
  }
}

}  // namespace
}  // namespace bubblesim::test::test_ttt_file
