// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_file.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "bubblesim/nearest_names.hpp"
#include "files/file_text.hpp"
#include "meshes/finish_mesh.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/mesh_materials.hpp"

namespace bubblesim {
namespace {

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

std::shared_ptr<const TriangleMesh> read(const MeshRequest& request, const MeshReader::Content& file,
                                         MeshReader& reader) {
  const Vector3& scale = request.scale;
  MeshContent content =
      reader.read({request.file.string(), file.size, file.digest, {scale.x(), scale.y(), scale.z()}, request.submesh});
  if (!content.error.empty()) {
    throw MeshError(content.error + did_you_mean(request.submesh, lines_of(content.part_names)));
  }
  TriangleMesh& mesh = content.mesh;
  mesh.materials = mesh_materials(content.materials, request.file);
  if (mesh.materials.empty()) mesh.material_of.clear();
  if (!request.submesh.empty() && request.center) move_to_middle(mesh);
  return finish_mesh(std::move(mesh));
}

/// What became of a file's content.
struct Known {
  std::weak_ptr<const TriangleMesh> mesh;
  std::optional<std::string> error;  ///< of a file that cannot be used, so that it is not read for each use
};

}  // namespace

std::shared_ptr<const TriangleMesh> load_mesh(const MeshRequest& request, MeshReader& reader) {
  // Materials and textures are in files next to the mesh, so equal meshes may look different in other folders.
  using Key = std::tuple<std::string, std::uint64_t, std::uint64_t, double, double, double, std::string, bool>;
  static std::mutex mutex;
  static std::map<Key, Known> known;
  const std::scoped_lock lock(mutex);
  const MeshReader::Content file = reader.content(request.file.string());
  const Key key{(request.file.parent_path() / request.file.extension()).string(),
                file.size,
                file.digest,
                request.scale.x(),
                request.scale.y(),
                request.scale.z(),
                request.submesh,
                request.center};
  if (const auto found = known.find(key); found != known.end()) {
    if (std::shared_ptr<const TriangleMesh> mesh = found->second.mesh.lock()) return mesh;
    if (found->second.error) throw MeshError(*found->second.error);
  }
  for (auto entry = known.begin(); entry != known.end();) {
    entry = entry->second.mesh.expired() && !entry->second.error ? known.erase(entry) : std::next(entry);
  }
  try {
    std::shared_ptr<const TriangleMesh> mesh = read(request, file, reader);
    known.insert_or_assign(key, Known{mesh, {}});
    return mesh;
  } catch (const MeshError& error) {
    known.insert_or_assign(key, Known{{}, error.what()});
    throw;
  }
}

}  // namespace bubblesim
