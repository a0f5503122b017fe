// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/scene_loader.hpp"
#include "file_of.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {

void read_scene(std::string_view data) {
  static const FileOf kFile("fuzz.sdf");
  kFile.write(data);
  try {
    bubblesim::read_scene(kFile.path().string());
  } catch (const SceneError& error) {
    require(!error.problems.empty(), "an error of a scene names a problem");
  }
}

}  // namespace bubblesim::fuzz
