// SPDX-License-Identifier: BSD-3-Clause
// The top level of a file, and what all objects have in common.
#include "load/ttt/scene_file.hpp"

#include <set>

#include "load/ttt/container.hpp"
#include "load/ttt/read_objects.hpp"
#include "load/ttt/tag_list.hpp"

namespace bubblesim::ttt {
namespace {

constexpr std::size_t kMostObjects = 200000;
constexpr std::size_t kMostTriangles = 20'000'000;
constexpr double kFarthest = 1e4;  // m, from the parent
constexpr int kMostTexturePixels = 8192;

const std::map<std::string_view, const char*>& other_items() {
  static const std::map<std::string_view, const char*> names = {
      {"IKO", "old IK group"},           {"COL", "old collision object"}, {"DST", "old distance object"},
      {"PPL", "old path planning task"}, {"BBK", "old user interface"},   {"COB", "custom object"},
  };
  return names;
}

Image read_image(const TagList& list) {
  Image image;
  auto size = list.item("Ipa");
  auto pixels = list.item("Img");
  if (!size || !pixels) return image;
  const std::size_t start = size->offset();
  image.id = size->i32();
  image.width = size->i32();
  image.height = size->i32();
  const auto is_side = [](int side) { return side > 0 && side <= kMostTexturePixels; };
  if (!is_side(image.width) || !is_side(image.height)) fail_at(start, "a texture must have 1 to 8192 pixels a side");
  const std::size_t channels = (list.u8("Bst").value_or(0) & 1U) != 0 ? 4 : 3;
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::string_view bytes = pixels->take(count * channels);
  image.rgb.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.rgb.push_back(static_cast<std::uint8_t>(bytes[i * channels + c]));
  }
  return image;
}

Object read_common(const TagList& list, std::string_view tag, std::size_t offset) {
  Object object;
  object.tag = tag;
  auto ids = list.item("Ids");
  if (!ids) fail_at(offset, "the object has no handle (Ids): it is left out");
  object.handle = ids->i32();
  object.parent = ids->i32();
  object.pose = list.rotation_first("Cfq", "_fq").value_or(Pose());
  note_damage(list.damage(), [&] {
    if (object.pose.position.norm() <= kFarthest) return;
    object.pose.position = Vector3();
    fail_at(offset, "the position is out of range");
  });
  object.old_name = list.text("Nme").value_or("");  // with `#0` for copies
  object.alias = list.text("Ali").value_or(object.old_name.substr(0, object.old_name.find('#')));
  const auto base = list.u8("Va3") ? list.u8("Va3") : list.u8("Va2") ? list.u8("Va2") : list.u8("Var");
  object.is_model = (base.value_or(0) & 1U) != 0;
  object.model_flags = static_cast<unsigned>(list.integer("Mpo", 0));
  if ((object.model_flags & 0xf000U) == 0xf000U) object.is_model = false;
  object.layers = list.u16("Lar").value_or(0xff);
  object.order = list.integer("Cor", -1);
  object.parameters = read_parameters(list.list("Lsp"));
  object.data = read_custom_data(list);
  return object;
}

class FileReader {
 public:
  explicit FileReader(SceneFile& file) : file_(file) {}

  void read(const std::string& content) {
    Bytes bytes(content);
    const TagList top(bytes);
    // Objects refer to what may come after them.
    for (const Item& item : top.items()) {
      Bytes inner = item.content.noting(damage_);
      if (item.tag == "VIN") meshes_.add(TagList(inner));
      if (item.tag == "DMA") add_material(TagList(inner));
    }
    note_for("");
    for (const Item& item : top.items()) read_item(item);
    file_.is_scene = top.has("ENV");
    if (file_.is_scene) {
      const auto list = [&](std::string_view tag) {
        const auto found = top.item(tag);
        if (!found) return TagList();
        Bytes inner = found->noting(damage_);
        return TagList(inner);
      };
      file_.settings = read_settings(list("SIM"), list("DYN"), list("ENV"), list("SET"));
      note_for("");
    }
  }

 private:
  /// Attributes the damage that was noted since the last call.
  void note_for(const std::string& alias) {
    for (std::string& what : damage_) file_.damaged.push_back({alias, std::move(what)});
    damage_.clear();
  }

  void add_material(const TagList& list) {
    note_damage(&damage_, [&] {
      if (auto id = list.item("Ipa")) materials_.emplace(id->i32(), list);
    });
  }

  void read_item(const Item& item) {
    static const std::set<std::string_view> objects = {"SHP", "JNT", "DMY", "SNR", "RSN", "FSE", "CMA", "LGT", "SCT",
                                                       "GRH", "PAT", "MIL", "MIR", "OCT", "PTC", "MKR", "CSO"};
    static const std::set<std::string_view> known = {"MTC", "BBC", "DMA", "VIN", "SET", "ENV", "DYN",
                                                     "SIM", "CDA", "CDS", "VEW", "GHO", "ORD"};
    Bytes bytes = item.content.noting(damage_);
    if (objects.count(item.tag) > 0) {
      if (file_.objects.size() == kMostObjects) fail_at(bytes.offset(), "the file has more than 200000 objects");
      read_object(item.tag, bytes);
    } else if (item.tag == "LST") {
      note_damage(&damage_, [&] { add_script(read_script(TagList(bytes))); });
    } else if (item.tag == "GRP") {
      note_damage(&damage_, [&] { file_.collections.push_back(read_collection(TagList(bytes))); });
    } else if (item.tag == "TEX") {
      note_damage(&damage_, [&] {
        if (Image image = read_image(TagList(bytes)); image.width > 0) file_.images.push_back(std::move(image));
      });
    } else if (const auto other = other_items().find(item.tag); other != other_items().end()) {
      ++file_.left_out[other->second];
    } else if (known.count(item.tag) == 0) {
      read_unknown(item.tag, bytes);
    }
    note_for("");
  }

  /// An item of a later version. It is an object if it begins like one, and then keeps its place in the tree.
  void read_unknown(std::string_view tag, Bytes bytes) {
    ++file_.left_out["item '" + std::string(tag) + "' that is not known"];
    Damage ignored;
    Bytes copy = Bytes(bytes).noting(ignored);
    const TagList common(copy);
    if (common.has("3do") && common.has("Ids") && file_.objects.size() < kMostObjects) read_object(tag, bytes);
  }

  void read_object(std::string_view tag, Bytes bytes) {
    const std::size_t start = bytes.offset();
    const TagList common(bytes);
    std::optional<Object> object;
    note_damage(&damage_, [&] { object = read_common(common, tag, start); });
    if (!object) return note_for("");
    if (!handles_.insert(object->handle).second) {
      damage_.push_back("at byte " + std::to_string(start) + ": the handle " + std::to_string(object->handle) +
                        " is that of another object: nothing can refer to this one");
      object->handle = free_handle();
    }
    note_damage(&damage_, [&] { read_own(TagList(bytes), tag, *object); });
    note_for(object->alias);
    file_.objects.push_back(std::move(*object));
  }

  void read_own(const TagList& own, std::string_view tag, Object& object) {
    if (tag == "SHP") object.details = read_shape(own, sources_);
    if (tag == "JNT") object.details = read_joint(own);
    if (tag == "SNR") object.details = read_proximity_sensor(own);
    if (tag == "RSN") object.details = read_vision_sensor(own);
    if (tag == "FSE") object.details = read_force_sensor(own);
    if (tag == "DMY") object.details = read_dummy(own);
    if (tag == "LGT") object.details = read_lamp(own);
    if (tag == "PAT") object.details = read_path(own);
    if (tag == "SCT") {
      const TagList list = own.list("Soo");
      Script script = read_script(list);
      constexpr unsigned kIsPartOfParent = 4;
      script.object = object.parent;
      if ((list.u8("Va3").value_or(0) & kIsPartOfParent) == 0) script.holder = object.handle;
      add_script(std::move(script));
    }
  }

  int free_handle() {
    // Handles of files are small; those from here on are none of the file's so far, or they would be taken.
    constexpr int kFirst = 1'000'000'000;
    int handle = kFirst + static_cast<int>(file_.objects.size());
    while (!handles_.insert(handle).second) ++handle;
    return handle;
  }

  void add_script(Script script) { file_.scripts.push_back(std::move(script)); }

  SceneFile& file_;
  MeshData meshes_;
  std::map<int, TagList> materials_;
  std::set<int> handles_;
  Damage damage_;  // of the item that is read
  ShapeSources sources_{meshes_, materials_, kMostTriangles};
};

}  // namespace

SceneFile read_scene_file(std::string_view file) {
  const Container container = open_container(file);
  SceneFile scene;
  scene.serialization = container.serialization;
  scene.program_version = container.program_version;
  if (container.serialization > kNewestFormat) {
    ++scene.left_out["format of a later version (" + std::to_string(container.serialization) + "): what it has anew"];
  }
  FileReader(scene).read(container.content);
  return scene;
}

}  // namespace bubblesim::ttt
