// SPDX-License-Identifier: BSD-3-Clause
#include "file_of.hpp"
#include "load/materials/material_scripts.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {

void read_material(std::string_view data) {
  static const FileOf kFile("fuzz.material");
  kFile.write(data);
  script_material("Fuzz", {kFile.path()});
}

}  // namespace bubblesim::fuzz
