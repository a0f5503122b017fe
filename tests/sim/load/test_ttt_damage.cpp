// SPDX-License-Identifier: BSD-3-Clause
// Files of CoppeliaSim that are damaged: what can be read is read, and the rest is noted.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "load/ttt/bytes.hpp"
#include "load/ttt/groups.hpp"
#include "load/ttt/scene_file.hpp"
#include "load/ttt/structure.hpp"
#include "ttt_writer.hpp"

namespace bubblesim::test::test_ttt_damage {
namespace {

using namespace bubblesim::ttt;
using namespace ttt_writer;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// What is noted as damaged in a file that is read nevertheless.
std::string noted(const std::string& bytes) {
  std::string all;
  for (const DamagedPart& part : read_scene_file(bytes).damaged) all += part.object + ": " + part.what + "\n";
  return all;
}

TEST(TttDamage, KeepsTheSecondOfTwoObjectsWithOneHandleWithoutIt) {
  const SceneFile scene = read_scene_file(file({{"DMY", 1, -1, "a"}, {"DMY", 1, -1, "b"}, {"DMY", 2, 1, "c"}}));
  ASSERT_EQ(scene.objects.size(), 3U);
  EXPECT_EQ(scene.objects[0].handle, 1);
  EXPECT_NE(scene.objects[1].handle, 1);
  EXPECT_NE(scene.objects[1].handle, 2);
  ASSERT_EQ(scene.damaged.size(), 1U);
  EXPECT_EQ(scene.damaged[0].object, "b");
  EXPECT_TRUE(holds(scene.damaged[0].what, "handle 1"));
}

TEST(TttDamage, NotesNumbersThatAreNotFiniteAndQuaternionsOfZero) {
  EXPECT_TRUE(holds(noted(file({{"DMY", 1, -1, "far", {1, 0, 0, 0, NAN, 0, 0}}})), "far: at byte"));
  EXPECT_TRUE(holds(noted(file({{"DMY", 1, -1, "far", {1, 0, 0, 0, NAN, 0, 0}}})), "not finite"));
  EXPECT_TRUE(holds(noted(file({{"DMY", 1, -1, "", {0, 0, 0, 0, 0, 0, 0}}})), "quaternion is zero"));
  EXPECT_EQ(read_scene_file(file({{"DMY", 1, -1, "", {0, 0, 0, 0, 0, 0, 0}}})).objects.size(), 1U);
}

TEST(TttDamage, KeepsTheRestOfAnObjectWithADamagedItem) {
  const std::string own = item("Jtt", ints({11})) + item("_mr", doubles({NAN, 1})) + item("_rt", doubles({0.5}));
  const SceneFile scene = read_scene_file(file({{"JNT", 1, -1, "slide", {1, 0, 0, 0, 0, 0, 0}, "", own}}));
  const Joint* slide = scene.objects.at(0).as<Joint>();
  ASSERT_NE(slide, nullptr);
  EXPECT_EQ(slide->type, JointType::kPrismatic);
  EXPECT_EQ(slide->position, 0.5);
  ASSERT_EQ(scene.damaged.size(), 1U);
  EXPECT_EQ(scene.damaged[0].object, "slide");
}

TEST(TttDamage, KeepsAnObjectOfAKindThatIsNotKnown) {
  const std::string common = item("3do", byte(0) + byte(0) + byte(0));
  const SceneFile scene = read_scene_file(
      file({{"NEW", 1, -1, "thing", {1, 0, 0, 0, 1, 2, 3}, common, item("Xyz", "?")}, {"DMY", 2, 1, "tip"}}));
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].alias, "thing");
  EXPECT_EQ(scene.objects[0].pose.position, Vector3(1, 2, 3));
  EXPECT_EQ(scene.left_out.count("item 'NEW' that is not known"), 1U);
}

TEST(TttDamage, KeepsTheNumbersOfArraysBehindADamagedOne) {
  const std::string points = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string arrays = item("Ver", points.substr(0, 10)) + item("Ver", points) + item("Ind", ints({0, 1, 2}));
  const auto mesh = [](int vertices) {
    const std::string list = item("Vev", ints({vertices})) + item("Inv", ints({0}));
    return item("Ge2", item("Gst", "EOO" + list + "EOO") + "EOO");
  };
  const std::string others = item("VIN", arrays + "EOO") + item("ENV", "EOO");
  const SceneFile scene = read_scene_file(file({{"SHP", 1, -1, "lost", {1, 0, 0, 0, 0, 0, 0}, "", mesh(0)},
                                                {"SHP", 2, -1, "kept", {1, 0, 0, 0, 0, 0, 0}, "", mesh(1)}},
                                               others));
  EXPECT_EQ(scene.objects.at(1).as<Shape>()->parts.at(0).triangles->size(), 1U);
  EXPECT_EQ(scene.objects.at(0).as<Shape>()->parts.at(0).triangles->size(), 0U);
  EXPECT_EQ(scene.damaged.size(), 2U);  // the array, and the mesh that refers to it
}

TEST(TttDamage, LeavesOutMeshesWithTrianglesBeyondTheVertices) {
  const std::string mesh = item("Ver", floats({0, 0, 0, 1, 0, 0, 0, 1, 0})) + item("Ind", ints({0, 1, 3}));
  const std::string own = item("Ge2", item("Gst", "EOO" + mesh + "EOO") + "EOO");
  const std::string bytes = file({{"SHP", 1, -1, "x", {1, 0, 0, 0, 0, 0, 0}, "", own}});
  EXPECT_TRUE(holds(noted(bytes), "no vertex"));
  EXPECT_TRUE(read_scene_file(bytes).objects.at(0).as<Shape>()->parts.at(0).triangles->empty());
}

TEST(TttDamage, LeavesOutMeshesWithoutAnyArea) {
  const auto parts = [](std::initializer_list<float> points) {
    const std::string mesh = item("Ver", floats(points)) + item("Ind", ints({0, 1, 2}));
    const std::string own = item("Ge2", item("Gst", "EOO" + mesh + "EOO") + "EOO");
    const std::string bytes = file({{"SHP", 1, -1, "x", {1, 0, 0, 0, 0, 0, 0}, "", own}});
    return std::pair(read_scene_file(bytes).objects.at(0).as<Shape>()->parts.at(0).triangles->size(), noted(bytes));
  };
  EXPECT_EQ(parts({0, 0, 0, 1, 0, 0, 0, 1e-3F, 0}).first, 1U);
  EXPECT_EQ(parts({0, 0, 0, 1, 0, 0, 2, 0, 0}).first, 0U);
  EXPECT_TRUE(holds(parts({1, 1, 1, 1, 1, 1, 1, 1, 1}).second, "no triangle with an area"));
  EXPECT_TRUE(holds(parts({0, 0, 0, 1e7F, 0, 0, 0, 1e7F, 0}).second, "50 km"));
}

TEST(TttDamage, PutsACentreOfMassThatCannotBeAtTheOrigin) {
  ObjectText shape{"SHP", 1, -1, "heavy", {1, 0, 0, 0, 0, 0, 0}, "", cuboid(kDynamic)};
  const std::string origin = item("Com", doubles({0, 0, 0}));
  shape.own.replace(shape.own.find(origin), origin.size(), item("Com", doubles({0, 0, 1e30})));
  const SceneFile scene = read_scene_file(file({shape}));
  EXPECT_EQ(scene.objects.at(0).as<Shape>()->centre_of_mass, Vector3());
  ASSERT_EQ(scene.damaged.size(), 1U);
  EXPECT_NE(scene.damaged[0].what.find("the centre of mass is out of range"), std::string::npos);
}

TEST(TttDamage, LeavesOutCompoundsThatNestTooDeep) {
  std::string compound = "EOO";
  for (int i = 0; i < 20'000; ++i) compound = item("Wrp", compound) + "EOO";
  const std::string own = item("Ge2", item("Gsg", compound) + "EOO");
  EXPECT_TRUE(holds(noted(file({{"SHP", 1, -1, "x", {1, 0, 0, 0, 0, 0, 0}, "", own}})), "64 deep"));
}

/// A file with an object of each kind.
std::string rich_file() {
  constexpr std::array<double, 7> kOrigin{1, 0, 0, 0, 0, 0, 0};
  const std::string volume = item("Snt", ints({3})) + item("_s3", doubles({0, 1, 0, 0, 0, 0, 0.1, 0.2, 0.5}));
  const std::string sonar = item("Snt", ints({33})) + item("Sox", ints({50})) + item("Vod", volume + "EOO");
  const std::string eye = item("_cp", doubles({1, 1, 0.01, 5})) + item("Res", ints({32, 16})) + item("Va3", byte(1));
  const std::string lamp =
      item("_p2", ints({2, 1}) + doubles({1})) + item("_p3", doubles({0.5})) + item("Cas", byte(1));
  const std::string points = item("Ver", floats({0, 0, 0, 1, 0, 0, 0, 1, 0})) + item("Ind", ints({0, 2, 1}));
  const std::string image = item("Ipa", ints({4, 2, 2})) + item("Bst", byte(0)) + item("Img", std::string(12, 'x'));
  const std::string mesh =
      item("Vev", ints({0})) + item("Inv", ints({0})) +
      item("Toj", item("_ob", ints({4, 0}) + doubles({1, 1})) + item("Ftc", floats({0, 0, 1, 0, 1, 1})) + "EOO");
  const std::string compound = item("Wrp", item("Geo", "EOO" + mesh + "EOO") + "EOO");
  const std::string shape = item("Ge2", item("Gsg", item("_as", doubles({3})) + compound + "EOO") + "EOO");
  const std::string script = item("Si2", ints({60, 3, 1})) + item("Ste", "print(1)") + item("Lne", text("lua"));
  const std::string group =
      item("Gix", ints({50})) + item("Asg", item("Obj", ints({3, 0})) + item("Gty", byte(1)) + "EOO");
  return file(
      {{"SHP", 1, -1, "base", kOrigin, item("Cda", item("Cdt", text("tag") + text("bytes")) + "EOO"), cuboid(0)},
       {"JNT", 2, 1, "motor", kOrigin, "", joint(5)},
       {"SHP", 3, 2, "arm", kOrigin,
        item("Lsp", item("Par", ints({1}) + text("a") + text("b") + text("c") + ints({0})) + "EOO"), cuboid(kDynamic)},
       {"SHP", 4, 3, "cover", kOrigin, "", shape},
       {"DMY", 5, 4, "tip", kOrigin, "", item("Lli", ints({6})) + item("Dl2", ints({0}))},
       {"DMY", 6, 1, "goal", kOrigin, "", item("Lli", ints({5})) + item("Dl2", ints({0}))},
       {"SNR", 7, 3, "sonar", kOrigin, "", sonar},
       {"RSN", 8, 3, "eye", kOrigin, "", eye},
       {"FSE", 9, 3, "force", kOrigin, "", item("Vab", byte(1))},
       {"SHP", 10, 9, "tool", kOrigin, "", cuboid(kDynamic)},
       {"LGT", 11, -1, "lamp", kOrigin, "", lamp},
       {"SCT", 12, 3, "Script", kOrigin, "", item("Soo", script + "EOO")}},
      item("VIN", points + "EOO") + item("TEX", image + "EOO") + item("LST", script + "EOO") +
          item("GRP", group + "EOO") + item("DYN", item("_n3", ints({1}) + doubles({0, 0, -9.81})) + "EOO") +
          item("SIM", item("_t3", doubles({0.05})) + "EOO") + item("ENV", item("Vil", byte(255) + byte(0)) + "EOO"));
}

/// A byte, or a number of four or eight bytes, becomes one that files should not have.
void damage(std::string& bytes, std::mt19937& random) {
  const auto place = [&](std::size_t size) { return 1021 + random() % (bytes.size() - 1021 - size); };
  const auto put = [&](const std::string& value) { bytes.replace(place(value.size()), value.size(), value); };
  static const double kDoubles[] = {0, -1, 1e300, -1e300, 1e-300, NAN, INFINITY};
  static const std::int32_t kInts[] = {-1, 0, 1, INT32_MAX, INT32_MIN, 0x01000000, 3};
  switch (random() % 4) {
    case 0:
      return put(raw(kDoubles[random() % 7]));
    case 1:
      return put(raw(kInts[random() % 7]));
    case 2:
      bytes.erase(place(1), 1 + random() % 8);
      return;
    default:
      put(std::string(1, static_cast<char>(random() & 0xffU)));
  }
}

TEST(TttDamage, SurvivesDamageAnywhere) {
  const std::string whole = rich_file();
  EXPECT_EQ(noted(whole), "");
  std::mt19937 random(1);
  int refused = 0;
  int read = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string damaged = whole;
    for (unsigned many = 1 + random() % 3; many > 0; --many) damage(damaged, random);
    if (i % 10 == 0) damaged.resize(random() % damaged.size());
    try {
      const SceneFile scene = read_scene_file(damaged);
      groups_of(scene, structure_of(scene));
      ++read;
    } catch (const FormatError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(holds(message, "at byte") || holds(message, "nested")) << message;
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(read, 2000);
}

TEST(TttDamage, TakesAsDeepATreeAsAFileCanHave) {
  std::vector<ObjectText> objects;
  for (int i = 0; i < 200'000; ++i) objects.push_back({"DMY", i, i - 1});
  const SceneFile scene = read_scene_file(file(objects));
  EXPECT_EQ(scene.objects.size(), 200'000U);
  EXPECT_THROW(structure_of(scene), FormatError);  // paths of scripts would be as long
}

}  // namespace
}  // namespace bubblesim::test::test_ttt_damage
