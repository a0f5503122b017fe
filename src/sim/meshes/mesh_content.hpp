// SPDX-License-Identifier: BSD-3-Clause
// Requests to the program mesh_reader, and its answers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bubblesim/triangle_mesh.hpp"

namespace bubblesim {

/// The requested file and part.
struct MeshQuery {
  std::string file;
  std::uint64_t size = 0;    ///< of the file, bytes
  std::uint64_t digest = 0;  ///< of its content: the reader caches the last file
  std::array<double, 3> scale{};
  std::string submesh;  ///< empty: all parts
};

/// A material of a mesh file.
struct FileMaterial {
  /// The part that is sent as raw bytes.
  struct Numbers {
    bool has_diffuse = false;
    Color diffuse;
    Color emissive;
    std::int32_t texture_width = 0;  ///< of an embedded texture whose bytes are rgb; 0: the bytes are an image file
    std::int32_t texture_height = 0;
  } numbers;
  std::string texture_uri;            ///< of a file next to the mesh; or empty
  std::vector<std::uint8_t> texture;  ///< embedded in the mesh file; or empty
};

struct MeshContent {
  std::string error;       ///< reason of a failure; empty on success
  std::string part_names;  ///< of the file, each followed by a newline, if the submesh is not found
  TriangleMesh mesh;       ///< without materials and bounding box
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

/// The same for an answer, except for its materials.
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

/// The same for a material.
template <class Stored, class Step>
void each_part(Stored& material, const Step& step) {
  step(material.numbers);
  step(material.texture_uri);
  step(material.texture);
}

}  // namespace bubblesim
