// SPDX-License-Identifier: BSD-3-Clause
// Image files.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "meshes.hpp"
#include "meshes/picture.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_pictures {
namespace {

namespace fs = std::filesystem;

const std::string kRedAndBlue = std::string("P6 2 1 255\n\xff\x00\x00\x00\x00\xff", 17);

TEST(Picture, IsReadAsRowsOfColours) {
  const TemporaryFile file("two.ppm", kRedAndBlue);
  const auto texture = read_texture(file.path());
  EXPECT_EQ(texture->width, 2);
  EXPECT_EQ(texture->height, 1);
  EXPECT_EQ(texture->rgb, (std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255}));
}

TEST(Picture, OfHeightsIsReadAsBrightness) {
  const TemporaryFile file("ramp.pgm", std::string("P5 3 1 255\n\x00\x33\xff", 14));
  const Heights heights = read_heights(file.path());
  EXPECT_EQ(heights.width, 3U);
  EXPECT_EQ(heights.height, 1U);
  EXPECT_EQ(heights.values, (std::vector<float>{0.0F, 0.2F, 1.0F}));  // of 255
}

TEST(Picture, IsSharedByItsUsers) {
  const TemporaryFile file("two.ppm", kRedAndBlue);
  const auto texture = read_texture(file.path());
  EXPECT_EQ(read_texture(file.path()), texture);
}

TEST(Picture, ThatCannotBeReadIsAnError) {
  const TemporaryFile text("text.png", "no image");
  EXPECT_EQ(mesh_problem([&] { read_texture(text.path()); }),
            "cannot be read as an image (unknown image type); supported formats: png, jpg, bmp, tga, gif");
  const TemporaryFile large("large.ppm", "P6 100000 100000 255\n");
  EXPECT_EQ(mesh_problem([&] { read_texture(large.path()); }), "has 100000 x 100000 pixels; the maximum is 67108864");
  EXPECT_EQ(mesh_problem([&] { read_heights("/nowhere/at_all.png"); }), "does not exist");
  const std::string fifo = text.folder() + "/fifo.png";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(mesh_problem([&] { read_texture(fifo); }), "is not a regular file");
}

/// Kills each reader of a picture that this process starts.
void crash_readers(const std::atomic<bool>& ended) {
  while (!ended) {
    for (const fs::directory_entry& task : fs::directory_iterator("/proc/self/task")) {
      std::ifstream children(task.path() / "children");
      for (pid_t child = 0; children >> child;) {
        std::string name;
        std::ifstream comm("/proc/" + std::to_string(child) + "/comm");
        if (std::getline(comm, name) && name == "picture_reader") ::kill(child, SIGSEGV);
      }
    }
  }
}

// stb_image of Debian 12 aborts on some damaged JPEG files, depending on what its memory held before.
TEST(Picture, WhoseReaderCrashesIsAnErrorAndTheNextOneIsRead) {
  const TemporaryFile file("long.ppm", kRedAndBlue);
  fs::resize_file(file.path(), 32U << 20U);  // which takes a while to send
  std::atomic<bool> ended = false;
  std::thread killer(crash_readers, std::cref(ended));
  std::string reported;
  while (reported.empty()) reported = mesh_problem([&] { read_texture(file.path()); });
  ended = true;
  killer.join();
  EXPECT_EQ(reported, "cannot be read as an image (its reader crashed with signal SEGV): the file is damaged");
  const TemporaryFile fine("two.ppm", kRedAndBlue);
  EXPECT_EQ(read_texture(fine.path())->rgb.size(), 6U);
}

}  // namespace
}  // namespace bubblesim::test::test_pictures
