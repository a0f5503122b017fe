// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {
namespace {

/// /Robot {base {eye, eye}, arm, Motor {axis2}}, /Other {base {eye}, wheel, wheel, wheel}, /Robot2 {arm}
class SceneTreePaths : public ::testing::Test {
 protected:
  ObjectId add(ObjectKind kind, const std::string& name, ObjectId parent) { return tree.add(kind, name, parent, 0); }

  /// The error text of find().
  std::string problem(const std::string& path, ObjectId from = kNoObject, std::size_t index = 0) const {
    try {
      tree.find(path, from, index);
    } catch (const NoSuchObject& error) {
      return error.what();
    }
    return "found";
  }

  SceneTree tree;
  ObjectId robot = add(ObjectKind::kModel, "Robot", kNoObject);
  ObjectId base = add(ObjectKind::kLink, "base", robot);
  ObjectId eye0 = add(ObjectKind::kSensor, "eye", base);
  ObjectId eye1 = add(ObjectKind::kSensor, "eye", base);
  ObjectId arm = add(ObjectKind::kLink, "arm", robot);
  ObjectId motor = add(ObjectKind::kJoint, "Motor", robot);
  ObjectId axis2 = add(ObjectKind::kJoint, "axis2", motor);
  ObjectId other = add(ObjectKind::kModel, "Other", kNoObject);
  ObjectId other_base = add(ObjectKind::kLink, "base", other);
  ObjectId other_eye = add(ObjectKind::kSensor, "eye", other_base);
  ObjectId wheel0 = add(ObjectKind::kLink, "wheel", other);
  ObjectId wheel1 = add(ObjectKind::kLink, "wheel", other);
  ObjectId wheel2 = add(ObjectKind::kLink, "wheel", other);
  ObjectId robot2 = add(ObjectKind::kModel, "Robot2", kNoObject);
  ObjectId robot2_arm = add(ObjectKind::kLink, "arm", robot2);
};

TEST_F(SceneTreePaths, AbsolutePathNamesEveryLevel) {
  EXPECT_EQ(tree.find("/Robot"), robot);
  EXPECT_EQ(tree.find("/Robot/base/eye"), eye0);
  EXPECT_EQ(tree.find("/Other/base/eye"), other_eye);
}

TEST_F(SceneTreePaths, AbsolutePathMayLeaveOutLevels) {
  EXPECT_EQ(tree.find("/Robot/eye"), eye0);
  EXPECT_EQ(tree.find("/Other/eye"), other_eye);
  EXPECT_EQ(tree.find("/Robot/axis2"), axis2);
}

TEST_F(SceneTreePaths, UniqueNameIsFoundAnywhere) {
  EXPECT_EQ(tree.find("/Motor"), motor);
  EXPECT_EQ(tree.find("/axis2"), axis2);
}

TEST_F(SceneTreePaths, LevelsInTheWrongOrderMatchNothing) { EXPECT_NE(problem("/base/Robot"), "found"); }

TEST_F(SceneTreePaths, NearestToTheTopCountsFirst) {
  const ObjectId deep = add(ObjectKind::kLink, "Solo", base);
  const ObjectId high = add(ObjectKind::kModel, "Solo", kNoObject);
  EXPECT_EQ(tree.find("/Solo"), high);
  EXPECT_EQ(tree.find("/Solo", kNoObject, 1), deep);
}

TEST_F(SceneTreePaths, DotIsTheObjectItself) {
  EXPECT_EQ(tree.find(".", base), base);
  EXPECT_EQ(tree.find("./", base), base);
  EXPECT_EQ(tree.find("./eye", base), eye0);
  EXPECT_EQ(tree.find("./eye", robot), eye0);
}

TEST_F(SceneTreePaths, TwoDotsAreTheParent) {
  EXPECT_EQ(tree.find("..", eye0), base);
  EXPECT_EQ(tree.find("../arm", base), arm);
  EXPECT_EQ(tree.find("../Other", robot), other) << "the parent of a model is the scene";
}

TEST_F(SceneTreePaths, TwoDotsRepeatedGoUpLevelByLevel) {
  EXPECT_EQ(tree.find("../..", eye0), robot);
  EXPECT_EQ(tree.find("../../arm", eye0), arm);
  EXPECT_EQ(tree.find("../../../Other", eye0), other);
  EXPECT_NE(problem("../../../../Other", eye0), "found") << "the scene has no parent";
}

TEST_F(SceneTreePaths, ColonIsTheModel) {
  EXPECT_EQ(tree.find(":", eye0), robot);
  EXPECT_EQ(tree.find(":/Motor", eye0), motor);
  EXPECT_EQ(tree.find(":", robot), robot) << "the model of a model is itself";
}

TEST_F(SceneTreePaths, TwoColonsAreWhatTheModelStandsIn) {
  EXPECT_EQ(tree.find("::/Other", eye0), other);
  EXPECT_NE(problem("::", eye0), "found") << "the scene is not an object";
}

TEST_F(SceneTreePaths, RelativePathsWithoutAStartBeginAtTheScene) {
  EXPECT_EQ(tree.find("./Robot/eye"), eye0);
  EXPECT_EQ(tree.find(":/Other"), other);
  EXPECT_NE(problem("../eye"), "found");
  EXPECT_NE(problem("::/eye"), "found");
}

/// /Car {lamp_0 and lamp_1 with the alias lamp, lamp with the alias horn}
class Aliases : public SceneTreePaths {
 protected:
  ObjectId car = add(ObjectKind::kModel, "Car", kNoObject);
  ObjectId lamp0 = tree.add(ObjectKind::kSensor, "lamp_0", car, 0, "lamp");
  ObjectId lamp1 = tree.add(ObjectKind::kSensor, "lamp_1", car, 1, "lamp");
  ObjectId horn = tree.add(ObjectKind::kSensor, "lamp", car, 2, "horn");
};

TEST_F(Aliases, AreTheNamesInPathsAndMayBeEqual) {
  EXPECT_EQ(tree.path(lamp1), "/Car/lamp[1]");
  EXPECT_EQ(tree.short_path(horn), "/horn");
  EXPECT_EQ(tree.find("/Car/lamp[1]"), lamp1);
  EXPECT_EQ(tree.find("/Car/lamp", kNoObject, 1), lamp1);
  EXPECT_EQ(tree.find("./lamp", car), lamp0);
  EXPECT_EQ(problem("/Car/lamp", kNoObject, 2), "only 2 objects match '/Car/lamp': there is no match with index 2");
  EXPECT_EQ(tree.at(lamp1).name, "lamp_1");
}

TEST_F(Aliases, LeaveTheNamesOfTheFileFindable) {
  EXPECT_EQ(tree.find("/Car/lamp_1"), lamp1);
  EXPECT_EQ(tree.find("/lamp_0"), lamp0);
}

TEST_F(Aliases, AreFreeWhenTheirObjectIsRemoved) {
  tree.remove(lamp0);
  EXPECT_EQ(tree.path(lamp1), "/Car/lamp");
  tree.remove(car);
  EXPECT_NE(problem("/horn"), "found");
}

TEST_F(SceneTreePaths, BracketsPickAmongSiblings) {
  EXPECT_EQ(tree.find("/Robot/eye[0]"), eye0);
  EXPECT_EQ(tree.find("/Robot/eye[1]"), eye1);
  EXPECT_EQ(tree.find("/wheel[2]"), wheel2);
  EXPECT_NE(problem("/wheel[3]"), "found");
  EXPECT_EQ(tree.find("/Robot2/arm[0]"), robot2_arm);
  EXPECT_NE(problem("/arm[1]"), "found") << "the two arms are not siblings";
}

TEST_F(SceneTreePaths, BracesPickInTheScene) {
  EXPECT_EQ(tree.find("/arm{0}"), arm);
  EXPECT_EQ(tree.find("/arm{1}"), robot2_arm);
  EXPECT_EQ(tree.find("/eye{2}"), other_eye);
  EXPECT_NE(problem("/arm{2}"), "found");
}

TEST_F(SceneTreePaths, StarStandsForAnyCharacters) {
  EXPECT_EQ(tree.find("/Rob*2"), robot2);
  EXPECT_EQ(tree.find("/Robot*", kNoObject, 1), robot2);
  EXPECT_EQ(tree.find("/*heel", kNoObject, 1), wheel1);
  EXPECT_EQ(tree.find("/M*t*r"), motor);
  EXPECT_EQ(tree.find("./*", base), eye0);
  EXPECT_NE(problem("/x*"), "found");
}

TEST_F(SceneTreePaths, ManyStarsAreDecidedQuickly) {
  const ObjectId odd = add(ObjectKind::kModel, std::string(60, 'a'), kNoObject);
  EXPECT_EQ(tree.find("/*a*a*a*a*a*a*a*a*a*a*"), odd);
  EXPECT_NE(problem("/*a*a*a*a*a*a*a*a*a*a*b"), "found");
}

TEST_F(SceneTreePaths, IndexPicksALaterMatch) {
  EXPECT_EQ(tree.find("/arm", kNoObject, 1), robot2_arm);
  EXPECT_EQ(problem("/arm", kNoObject, 2), "only 2 objects match '/arm': there is no match with index 2");
}

TEST_F(SceneTreePaths, SimilarNamesAreSuggested) {
  EXPECT_EQ(problem("/Moter"), "no object matches '/Moter'; did you mean /Motor, /Other?");
  EXPECT_EQ(problem("/Robot/bse"), "no object matches '/Robot/bse'; did you mean /Robot/base, /Robot/arm?");
  EXPECT_EQ(problem("./Motro", robot), "no object matches './Motro'; did you mean /Motor?");
  EXPECT_EQ(problem("/Quadrocopter"), "no object matches '/Quadrocopter'");
}

TEST_F(SceneTreePaths, NameWithoutSlashIsExplainedAndCorrected) {
  EXPECT_EQ(problem("Motor"),
            "no object matches 'Motor' (a path starts with '/', './', '../', ':/' or '::/'); did you mean /Motor?");
}

TEST_F(SceneTreePaths, EmptyPathsMatchNothing) {
  EXPECT_NE(problem(""), "found");
  EXPECT_NE(problem("/"), "found");
  EXPECT_NE(problem("//"), "found");
}

TEST_F(SceneTreePaths, MalformedIndicesArePartOfTheName) {
  for (const char* path :
       {"/arm[", "/arm]", "/arm[x]", "/arm[-1]", "/arm[0}", "/arm{0]", "/arm[99999999999999999999]", "/[0]"}) {
    EXPECT_NE(problem(path), "found") << path;
  }
}

TEST_F(SceneTreePaths, PathNamesAllLevelsAndNumbersSiblings) {
  EXPECT_EQ(tree.path(axis2), "/Robot/Motor/axis2");
  EXPECT_EQ(tree.path(eye1), "/Robot/base/eye[1]");
  EXPECT_EQ(tree.path(other_eye), "/Other/base/eye");
  EXPECT_EQ(tree.path(wheel0), "/Other/wheel[0]");
}

TEST_F(SceneTreePaths, ShortPathIsTheShortestUniqueEnding) {
  EXPECT_EQ(tree.short_path(motor), "/Motor");
  EXPECT_EQ(tree.short_path(arm), "/Robot/arm");
  EXPECT_EQ(tree.short_path(wheel1), "/wheel[1]");
}

TEST_F(SceneTreePaths, EveryPathLeadsBackToItsObject) {
  for (const ObjectId id : tree.objects()) {
    EXPECT_EQ(tree.find(tree.path(id)), id) << tree.path(id);
    EXPECT_EQ(tree.find(tree.short_path(id)), id) << tree.short_path(id);
  }
}

TEST_F(SceneTreePaths, SiblingModelsOfOneNameAreNumbered) {
  const ObjectId twin = add(ObjectKind::kModel, "Robot", kNoObject);
  EXPECT_EQ(tree.path(robot), "/Robot[0]");
  EXPECT_EQ(tree.path(twin), "/Robot[1]");
  EXPECT_EQ(tree.path(base), "/Robot[0]/base");
}

TEST_F(SceneTreePaths, UnknownHandlesAreNamed) {
  for (const ObjectId id : {kNoObject, ObjectId{99}, ObjectId{-5}}) {
    try {
      tree.at(id);
      ADD_FAILURE() << id;
    } catch (const NoSuchObject& error) {
      EXPECT_EQ(error.what(), "no object has the handle " + std::to_string(id));
    }
  }
}

TEST_F(SceneTreePaths, HandlesOfANewTreeCountUp) {
  EXPECT_EQ(robot, 0);
  EXPECT_EQ(robot2_arm, 14);
  EXPECT_EQ(tree.size(), 15U);
}

TEST_F(SceneTreePaths, RemovedObjectsAreNamed) {
  const auto error_of = [&](ObjectId id) {
    try {
      tree.at(id);
    } catch (const NoSuchObject& error) {
      return std::string(error.what());
    }
    return std::string("found");
  };
  tree.remove(other);
  EXPECT_EQ(error_of(wheel1), "the object with the handle " + std::to_string(wheel1) + " (/Other/wheel) was removed");
  EXPECT_EQ(error_of(other_eye),
            "the object with the handle " + std::to_string(other_eye) + " (/Other/base/eye) was removed");
  EXPECT_FALSE(tree.contains(other));
  EXPECT_EQ(tree.find("/base"), base);
  EXPECT_EQ(tree.size(), 9U);
}

TEST_F(SceneTreePaths, PlacesAreTakenAgainWithOtherHandles) {
  std::set<ObjectId> seen;
  for (int i = 0; i < 10'000; ++i) {
    const ObjectId id = add(ObjectKind::kModel, "Guest", kNoObject);
    EXPECT_TRUE(seen.insert(id).second) << id;
    EXPECT_EQ(tree.at(id).name, "Guest");
    EXPECT_EQ(tree.find("/Guest"), id);
    tree.remove(id);
    EXPECT_FALSE(tree.contains(id));
  }
  EXPECT_LT(tree.places(), 2000U);
  for (const ObjectId id : seen) EXPECT_THROW(tree.at(id), NoSuchObject);
}

TEST_F(SceneTreePaths, ObjectsComeInTheOrderInWhichTheyWereAdded) {
  for (int i = 0; i < 2000; ++i) tree.remove(add(ObjectKind::kModel, "Guest", kNoObject));
  const ObjectId first = add(ObjectKind::kModel, "First", kNoObject);
  const ObjectId second = add(ObjectKind::kModel, "Second", kNoObject);
  const std::vector<ObjectId> objects = tree.objects();
  EXPECT_EQ(objects.front(), robot);
  EXPECT_EQ(objects[objects.size() - 2], first);
  EXPECT_EQ(objects.back(), second);
}

TEST_F(SceneTreePaths, ModelOfAnObjectIsTheOneItStandsIn) {
  EXPECT_EQ(tree.model_of(eye1), robot);
  EXPECT_EQ(tree.model_of(axis2), robot);
  EXPECT_EQ(tree.model_of(robot2), robot2);
}

}  // namespace
}  // namespace bubblesim
