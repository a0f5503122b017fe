// SPDX-License-Identifier: BSD-3-Clause
// The examples in the pages about joints, models and surfaces load and run.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "bubblesim/scene_loader.hpp"
#include "bubblesim/world.hpp"
#include "scene_files.hpp"

namespace bubblesim::test::test_pages {
namespace {

struct Snippet {
  std::string page;
  std::string xml;
};

/// Completes an excerpt to a scene.
std::string completed(const std::string& xml) {
  if (xml.rfind("<model", 0) == 0) return in_world(xml);
  const std::string links = "<link name='base'>" + (xml.rfind("<collision", 0) == 0 ? xml : "") + "</link>";
  return in_world("<model name='m'>" + links + "<link name='arm'/>" + (xml.rfind("<joint", 0) == 0 ? xml : "") +
                  "</model>");
}

std::vector<Snippet> snippets() {
  const fs::path docs = BUBBLESIM_DOCS;
  const std::vector<fs::path> pages{docs / "joints.md", docs / "worlds" / "nested_models.md",
                                    docs / "worlds" / "surfaces.md"};
  std::vector<Snippet> found;
  for (const fs::path& page : pages) {
    std::ifstream in(page);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::string begin = "```xml\n";
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
      at += begin.size();
      found.push_back({page.stem().string(), text.substr(at, text.find("```", at) - at)});
    }
  }
  return found;
}

TEST(Pages, WhatTheyShowLoadsAndSteps) {
  const std::vector<Snippet> all = snippets();
  EXPECT_GE(all.size(), 11u);
  for (const Snippet& snippet : all) {
    SCOPED_TRACE(snippet.page);
    const TemporaryFile file("page.sdf", completed(snippet.xml));
    World world(read_scene(file.path()), 0);
    EXPECT_NO_THROW(world.advance(1, 0.005));
  }
}

}  // namespace
}  // namespace bubblesim::test::test_pages
