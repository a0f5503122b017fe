// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/picture.hpp"

#include "meshes/mesh_error.hpp"
#include "targets.hpp"

namespace bubblesim::fuzz {

void read_picture(std::string_view data) {
  try {
    decode_texture(reinterpret_cast<const unsigned char*>(data.data()), data.size());
  } catch (const MeshError&) {
    return;
  }
}

}  // namespace bubblesim::fuzz
