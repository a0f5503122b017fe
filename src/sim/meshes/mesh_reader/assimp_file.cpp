// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_reader/assimp_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>

#include "meshes/mesh_reader/collada_text.hpp"
#include "meshes/mesh_reader/file_materials.hpp"
#include "meshes/mesh_reader/gather.hpp"

namespace bubblesim {
namespace {

/// Opens what Assimp reads. Mesh files refer to other files: reading a FIFO or a device would never end.
class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return nullptr;
    return is_collada(file) ? open_plain(file) : DefaultIOSystem::Open(file, mode);
  }

 private:
  static bool is_collada(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& letter : extension) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return extension == ".dae";
  }

  static Assimp::IOStream* open_plain(const char* file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) return nullptr;
    const std::string plain = plain_collada(text.str());
    auto bytes = std::make_unique<std::uint8_t[]>(plain.size());
    std::copy(plain.begin(), plain.end(), bytes.get());
    return new Assimp::MemoryIOStream(bytes.release(), plain.size(), true);  // which deletes them
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
