// SPDX-License-Identifier: BSD-3-Clause
// What the program mesh_reader is asked for and what it answers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {

/// Which part of which file is wanted.
struct MeshQuery {
  std::string file;
  std::uint64_t size = 0;    ///< of the file, bytes
  std::uint64_t digest = 0;  ///< of its content: the reader keeps the last file
  std::array<double, 3> scale{};
  std::string submesh;  ///< empty: all parts
};

/// A material as the file has it.
struct FileMaterial {
  /// What can be sent as it is.
  struct Numbers {
    bool has_diffuse = false;
    Color diffuse;
    Color emissive;
    std::int32_t texture_width = 0;  ///< of a texture in the file whose bytes are rgb; 0: the bytes are a picture file
    std::int32_t texture_height = 0;
  } numbers;
  std::string texture_uri;            ///< of a file beside the mesh; or empty
  std::vector<std::uint8_t> texture;  ///< that the mesh file holds itself; or empty
};

struct MeshContent {
  std::string error;       ///< why there is no surface; empty when there is one
  std::string part_names;  ///< of the file, each ended by a newline, when the submesh is not found
  TriangleMesh mesh;       ///< without its materials and its box
  std::vector<FileMaterial> materials;
};

/// Sends or receives a query: `step` is called with each of its values.
template <class Query, class Step>
void each_value(Query& query, const Step& step) {
  step(query.file);
  step(query.size);
  step(query.digest);
  step(query.scale);
  step(query.submesh);
}

/// The same for an answer but its materials.
template <class Content, class Step>
void each_array(Content& content, const Step& step) {
  step(content.error);
  step(content.part_names);
  step(content.mesh.vertices);
  step(content.mesh.triangles);
  step(content.mesh.normals);
  step(content.mesh.texture_coordinates);
  step(content.mesh.material_of);
}

/// And for one of those.
template <class Stored, class Step>
void each_part(Stored& material, const Step& step) {
  step(material.numbers);
  step(material.texture_uri);
  step(material.texture);
}

}  // namespace bubblesim
