// SPDX-License-Identifier: BSD-3-Clause
#include "load/scene_text.hpp"

#include "files/file_text.hpp"
#include "load/urdf/xacro.hpp"

namespace bubblesim {

SceneText scene_text(const std::filesystem::path& file, const XacroArguments& arguments) {
  if (file.extension() == ".xacro") {
    return {run_xacro(file, arguments), file.string() + " (expanded by xacro)"};
  }
  return {read_text(file), file.string()};
}

}  // namespace bubblesim
