// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_reader/gather.hpp"

#include <assimp/scene.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

namespace bubblesim {
namespace {

TriangleMesh::Point to_point(const aiVector3D& vector) { return {vector.x, vector.y, vector.z}; }

bool is_stl(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension == ".stl";
}

class Gatherer {
 public:
  Gatherer(const aiScene& scene, const MeshQuery& query, std::set<std::string>& names)
      : scene_(scene), query_(query), names_(names), has_own_normals_(!is_stl(query.file)) {}

  TriangleMesh gather() {
    add_node(*scene_.mRootNode, aiMatrix4x4(), query_.submesh.empty());
    // Normals and texture coordinates are dropped unless all parts have them.
    if (!smooth_) mesh_.normals.clear();
    if (!textured_) mesh_.texture_coordinates.clear();
    return std::move(mesh_);
  }

 private:
  void add_node(const aiNode& node, const aiMatrix4x4& outer, bool wanted) {
    const aiMatrix4x4 transform = outer * node.mTransformation;
    names_.emplace(node.mName.C_Str());
    const bool named = wanted || query_.submesh == node.mName.C_Str();
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& part = *scene_.mMeshes[node.mMeshes[i]];
      names_.emplace(part.mName.C_Str());
      if (named || query_.submesh == part.mName.C_Str()) add_part(part, transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], transform, named);
  }

  void add_part(const aiMesh& part, aiMatrix4x4 transform) {
    const auto& [x, y, z] = query_.scale;
    aiMatrix4x4 scaling;
    aiMatrix4x4::Scaling(aiVector3D(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)), scaling);
    transform = scaling * transform;
    aiMatrix3x3 turn(transform);
    const bool mirrored = turn.Determinant() < 0;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const bool has_normals = part.HasNormals() && has_own_normals_;
    const aiMatrix3x3 normal_turn = turn.Inverse().Transpose();
    smooth_ = smooth_ && has_normals;
    textured_ = textured_ || part.HasTextureCoords(0);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      mesh_.vertices.push_back(to_point(transform * part.mVertices[i]));
      aiVector3D normal = has_normals ? normal_turn * part.mNormals[i] : aiVector3D();
      mesh_.normals.push_back(to_point(normal.NormalizeSafe()));
      const aiVector3D place = part.HasTextureCoords(0) ? part.mTextureCoords[0][i] : aiVector3D();
      mesh_.texture_coordinates.push_back({place.x, place.y});
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      const aiFace& face = part.mFaces[i];
      if (face.mNumIndices != 3) continue;
      TriangleMesh::Triangle triangle{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
      if (mirrored) std::swap(triangle[1], triangle[2]);
      mesh_.triangles.push_back(triangle);
      mesh_.material_of.push_back(static_cast<std::uint16_t>(part.mMaterialIndex));
    }
  }

  const aiScene& scene_;
  const MeshQuery& query_;
  TriangleMesh mesh_;
  std::set<std::string>& names_;
  bool has_own_normals_;  // those of STL are per triangle
  bool smooth_ = true;
  bool textured_ = false;
};

}  // namespace

TriangleMesh gather(const aiScene& scene, const MeshQuery& query, std::set<std::string>& names) {
  return Gatherer(scene, query, names).gather();
}

}  // namespace bubblesim
