// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "file_of.hpp"
#include "load/ttt/bytes.hpp"
#include "load/ttt/describe.hpp"
#include "load/ttt/scene_file.hpp"
#include "load/ttt/structure.hpp"
#include "load/ttt/write_scene.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {

void read_ttt(std::string_view data) {
  static const FileOf kPlace("scene.sdf");
  try {
    const ttt::SceneFile scene = ttt::read_scene_file(data);
    std::ostringstream text;
    ttt::describe(scene, ttt::structure_of(scene), text);
    ttt::write_scene(scene, "fuzz", kPlace.path().parent_path());
  } catch (const ttt::FormatError&) {
    return;
  }
}

}  // namespace bubblesim::fuzz
