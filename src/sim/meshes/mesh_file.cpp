// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <map>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "meshes/finish_mesh.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/mesh_materials.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

TriangleMesh::Point to_point(const aiVector3D& vector) { return {vector.x, vector.y, vector.z}; }

bool is_stl(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension == ".stl";
}

/// Gathers the parts of a file into one surface.
class Gatherer {
 public:
  Gatherer(const aiScene& scene, const MeshRequest& request) : scene_(scene), request_(request) {
    mesh_.materials = mesh_materials(scene, request.file);
  }

  TriangleMesh gather() {
    add_node(*scene_.mRootNode, aiMatrix4x4(), request_.submesh.empty());
    // What only some parts have, none keeps.
    if (!smooth_) mesh_.normals.clear();
    if (!textured_) mesh_.texture_coordinates.clear();
    return std::move(mesh_);
  }

  const std::set<std::string>& names() const { return names_; }

 private:
  void add_node(const aiNode& node, const aiMatrix4x4& outer, bool wanted) {
    const aiMatrix4x4 transform = outer * node.mTransformation;
    names_.emplace(node.mName.C_Str());
    const bool named = wanted || request_.submesh == node.mName.C_Str();
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& part = *scene_.mMeshes[node.mMeshes[i]];
      names_.emplace(part.mName.C_Str());
      if (named || request_.submesh == part.mName.C_Str()) add_part(part, transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], transform, named);
  }

  void add_part(const aiMesh& part, aiMatrix4x4 transform) {
    const Vector3& scale = request_.scale;
    aiMatrix4x4 scaling;
    aiMatrix4x4::Scaling(
        aiVector3D(static_cast<float>(scale.X()), static_cast<float>(scale.Y()), static_cast<float>(scale.Z())),
        scaling);
    transform = scaling * transform;
    aiMatrix3x3 turn(transform);
    const bool mirrored = turn.Determinant() < 0;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const bool has_normals = part.HasNormals() && !is_stl(request_.file);  // those of STL are its triangles' own
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
      if (!mesh_.materials.empty()) mesh_.material_of.push_back(static_cast<std::uint16_t>(part.mMaterialIndex));
    }
  }

  const aiScene& scene_;
  const MeshRequest& request_;
  TriangleMesh mesh_;
  std::set<std::string> names_;
  bool smooth_ = true;
  bool textured_ = false;
};

void move_to_middle(TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return;
  TriangleMesh::Point low = mesh.vertices.front();
  TriangleMesh::Point high = low;
  for (const TriangleMesh::Point& vertex : mesh.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], vertex[axis]);
      high[axis] = std::max(high[axis], vertex[axis]);
    }
  }
  for (TriangleMesh::Point& vertex : mesh.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis] -= (low[axis] + high[axis]) / 2;
  }
}

/// Parts of COLLADA have names and ids: a submesh may go by either.
TriangleMesh read(const MeshRequest& request, bool by_name, std::set<std::string>& names) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // z is up, whatever the file says
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, by_name);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(request.file.string(), aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw MeshError(std::string("cannot be read as a mesh (") + importer.GetErrorString() +
                    "); dae, stl and obj are known");
  }
  Gatherer gatherer(*scene, request);
  TriangleMesh mesh = gatherer.gather();
  names.insert(gatherer.names().begin(), gatherer.names().end());
  return mesh;
}

std::shared_ptr<const TriangleMesh> read(const MeshRequest& request) {
  if (!fs::is_regular_file(request.file)) throw MeshError("is no file");
  std::set<std::string> names;
  TriangleMesh mesh = read(request, true, names);
  if (mesh.triangles.empty() && !request.submesh.empty()) mesh = read(request, false, names);
  if (mesh.triangles.empty() && !request.submesh.empty()) {
    throw MeshError("has no submesh '" + request.submesh + "'" +
                    did_you_mean(request.submesh, {names.begin(), names.end()}));
  }
  if (!request.submesh.empty() && request.center) move_to_middle(mesh);
  return finish_mesh(std::move(mesh));
}

}  // namespace

std::shared_ptr<const TriangleMesh> load_mesh(const MeshRequest& request) {
  using Key = std::tuple<std::string, double, double, double, std::string, bool, fs::file_time_type>;
  static std::mutex mutex;
  static std::map<Key, std::weak_ptr<const TriangleMesh>> known;
  const std::scoped_lock lock(mutex);
  std::error_code missing;
  const Key key{request.file.string(),
                request.scale.X(),
                request.scale.Y(),
                request.scale.Z(),
                request.submesh,
                request.center,
                fs::last_write_time(request.file, missing)};
  std::weak_ptr<const TriangleMesh>& shared = known[key];
  if (std::shared_ptr<const TriangleMesh> mesh = shared.lock()) return mesh;
  std::shared_ptr<const TriangleMesh> mesh = read(request);
  shared = mesh;
  return mesh;
}

}  // namespace bubblesim
