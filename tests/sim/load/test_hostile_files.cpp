// SPDX-License-Identifier: BSD-3-Clause
// Files that would make a parser hang, use all memory or crash the process.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstdlib>

#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_hostile_files {
namespace {

class HostileFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("bubblesim_hostile_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
    return (folder_ / file).string();
  }
  void write_model(const std::string& name, const std::string& content, const std::string& version = "1.9") const {
    write(name + "/model.config",
          "<model><name>" + name + "</name><sdf version='" + version + "'>model.sdf</sdf></model>");
    write(name + "/model.sdf",
          "<sdf version='" + version + "'>\n<model name='" + name + "'>" + content + "</model></sdf>");
  }
  std::string reported_for(const std::string& text, const std::string& name = "scene.sdf") const {
    return error_text_of([&] { read_scene(write(name, text)); });
  }
  template <class Load>
  static std::string error_text_of(const Load& load) {
    try {
      load();
    } catch (const SceneError& error) {
      return error.what();
    }
    return "it loads";
  }
  static std::string included(const std::string& name) { return "<include><uri>model://" + name + "</uri></include>"; }
  static bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

  fs::path folder_;
};

TEST_F(HostileFiles, AModelThatIncludesItselfIsAnError) {
  write_model("self", included("self") + "<link name='l'/>");
  const std::string reported = reported_for(in_world(included("self")));
  EXPECT_TRUE(holds(reported, "self/model.sdf:2: the file includes itself")) << reported;
}

TEST_F(HostileFiles, ModelsThatIncludeEachOtherAreAnError) {
  write_model("a", included("b") + "<link name='l'/>");
  write_model("b", included("a") + "<link name='l'/>");
  const std::string reported = reported_for(in_world(included("a")));
  EXPECT_TRUE(holds(reported, "b/model.sdf:2: includes ")) << reported;
  EXPECT_TRUE(holds(reported, "a/model.sdf, which includes this file")) << reported;
}

TEST_F(HostileFiles, IncludesThatMultiplyAreAnError) {
  write_model("m0", "<link name='l'/>");
  for (int i = 1; i <= 10; ++i) {
    std::string ten;
    for (int n = 0; n < 10; ++n) ten += included("m" + std::to_string(i - 1));
    write_model("m" + std::to_string(i), ten);
  }
  const std::string reported = reported_for(in_world(included("m10")));
  EXPECT_TRUE(holds(reported, "more than 1000000,")) << reported;
}

TEST_F(HostileFiles, AnIncludedFifoIsAnError) {
  fs::create_directories(folder_ / "pipe");
  ASSERT_EQ(::mkfifo((folder_ / "pipe/model.config").c_str(), 0600), 0);
  const std::string reported = reported_for(in_world(included("pipe")));
  EXPECT_TRUE(holds(reported, "pipe/model.config, which is not a regular file")) << reported;
}

TEST_F(HostileFiles, ADeviceAsAHeightmapIsAnError) {
  const std::string reported =
      reported_for(in_world("<model name='m'><link name='l'><collision name='c'><geometry><heightmap><uri>/dev/zero"
                            "</uri></heightmap></geometry></collision></link></model>"));
  EXPECT_TRUE(holds(reported, "/m/l/c: /dev/zero is not a regular file")) << reported;
}

TEST_F(HostileFiles, AModelConfigMayBeAlmostEmpty) {
  write_model("nameless", "<link name='l'/>");
  write("nameless/model.config", "<model><description/></model>");
  EXPECT_EQ(reported_for(in_world(included("nameless"))), "it loads") << "its model.sdf is used";
}

TEST_F(HostileFiles, NamesAndTextsOfMegabytesAreErrorsOfALine) {
  const std::string megabytes(20'000'000, 'a');
  const std::string named = reported_for(in_world("<model name='" + megabytes + "'><link name='l'/></model>"));
  EXPECT_TRUE(holds(named, "scene.sdf:1: the name 'aaaa")) << named.substr(0, 200);
  const std::string posed = reported_for(in_world("<model name='m'><pose>" + megabytes + "</pose></model>"));
  EXPECT_TRUE(holds(posed, "scene.sdf:1: the text of <pose> 'aaaa")) << posed.substr(0, 200);
  EXPECT_LT(named.size() + posed.size(), 1000U);
}

TEST_F(HostileFiles, ThousandsOfModelsTakeMemoryForWhatTheyHold) {
  if (std::getenv("UBSAN_OPTIONS") != nullptr) GTEST_SKIP() << "sanitizers take memory of their own";
  std::string models;
  for (int i = 0; i < 3000; ++i) {
    models += "<model name='m" + std::to_string(i) +
              "'><link name='l'><collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry>"
              "</collision></link></model>";
  }
  EXPECT_EQ(read_scene(write("many.sdf", in_world(models))).models.size(), 3000U);
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  EXPECT_LT(used.ru_maxrss, 500'000) << "kB";
}

TEST_F(HostileFiles, TenThousandsOfLinksAreRead) {
  std::string links;
  for (int i = 0; i < 20'000; ++i) links += "<link name='l" + std::to_string(i) + "'/>";
  EXPECT_EQ(read_scene(write("many.sdf", in_world("<model name='m'>" + links + "</model>"))).models.at(0).links.size(),
            20'000U);
}

TEST_F(HostileFiles, ElementsNestedWithoutEndAreAnError) {
  std::string models;
  for (int i = 0; i < 100'000; ++i) models += "<model name='m'>";
  const std::string reported = reported_for("<sdf version='1.9'>" + models);
  EXPECT_TRUE(holds(reported, "scene.sdf:1: ")) << reported.substr(0, 200);
}

TEST_F(HostileFiles, XacroThatDoesNotEndIsEnded) {
  ::setenv("BUBBLESIM_XACRO_SECONDS", "1", 1);
  const std::string reported = reported_for("<robot name='r'><link name='${10**10**10}'/></robot>", "endless.xacro");
  ::unsetenv("BUBBLESIM_XACRO_SECONDS");
  EXPECT_TRUE(holds(reported, "endless.xacro: xacro did not end within 1.00 s and was killed")) << reported;
}

}  // namespace
}  // namespace bubblesim::test::test_hostile_files
