// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/reader/assimp_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <filesystem>
#include <set>
#include <stdexcept>

#include "meshes/reader/file_materials.hpp"
#include "meshes/reader/gather.hpp"

namespace bubblesim {
namespace {

/// Mesh files refer to other files: reading a FIFO or a device would never end.
class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

}  // namespace

void AssimpFile::prepare(const MeshQuery& query) {
  if (query.file != file_ || query.digest != digest_) importer_.reset();
}

const aiScene& AssimpFile::scene(const MeshQuery& query, bool by_name) {
  if (importer_ != nullptr && by_name_ == by_name) return *importer_->GetScene();
  importer_ = std::make_unique<Assimp::Importer>();
  importer_->SetIOHandler(new RegularFiles);                                       // the importer deletes it
  importer_->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);  // z is up, regardless of the file
  importer_->SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, by_name);
  importer_->SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* read = importer_->ReadFile(query.file, aiProcess_Triangulate | aiProcess_SortByPType);
  if (read == nullptr || read->mRootNode == nullptr) {
    const std::string reason = importer_->GetErrorString();
    importer_.reset();
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw std::runtime_error("cannot be read as a mesh (" + reason + "); supported formats: dae, stl, obj");
  }
  file_ = query.file;
  digest_ = query.digest;
  by_name_ = by_name;
  return *read;
}

MeshContent AssimpFile::read(const MeshQuery& query) {
  std::set<std::string> names;
  MeshContent content;
  // Parts of COLLADA files have names and ids: a submesh may be given by either.
  for (const bool by_name : {true, false}) {
    const aiScene& read = scene(query, by_name);
    content.mesh = gather(read, query, names);
    if (content.mesh.triangles.empty() && !query.submesh.empty()) continue;
    content.materials = file_materials(read);
    return content;
  }
  for (const std::string& name : names) content.part_names += name + "\n";
  content.error = "has no submesh '" + query.submesh + "'";
  return content;
}

}  // namespace bubblesim
