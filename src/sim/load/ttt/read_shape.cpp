// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "load/ttt/read_objects.hpp"
#include "load/ttt/texture_projection.hpp"

namespace bubblesim::ttt {
namespace {

constexpr int kDeepest = 64;
constexpr double kLeastMass = 0.001;  // stands for 0
constexpr double kMostMass = 1e6;     // kg
constexpr double kMostSize = 1e5;     // m

void require_sane(double value, double low, double high, const char* what, std::size_t offset) {
  if (value < low || value > high) fail_at(offset, std::string(what) + " is out of range");
}

/// Whether a triangle is none but for rounding: readers of meshes drop the others.
bool has_area(const Vertices& vertices, const std::array<std::uint32_t, 3>& triangle) {
  constexpr double kLeastSine = 1e-5;
  const auto corner = [&](std::size_t i) {
    const auto& v = vertices[triangle[i]];
    return Vector3(v[0], v[1], v[2]);
  };
  const Vector3 a = corner(1) - corner(0);
  const Vector3 b = corner(2) - corner(0);
  const double longest = std::max({a.squaredNorm(), b.squaredNorm(), Vector3(b - a).squaredNorm()});
  return longest > 0 && a.cross(b).norm() > kLeastSine * longest;
}

/// Moments of inertia, divided by the mass, with their frame.
void read_inertia(const TagList& body, Shape& shape) {
  if (const auto com = body.numbers("", "Com", 3); !com.empty()) {
    const auto m = body.numbers("", "Imx", 9);
    if (m.empty()) return;
    const Pose frame = body.position_first("", "Ifr").value_or(Pose());
    const Matrix3 turn = frame.orientation.toRotationMatrix();
    const Matrix3 inertia = Matrix3{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
    shape.centre_of_mass = frame * Vector3(com[0], com[1], com[2]);
    shape.inertia = turn * ((inertia + inertia.transpose()) / 2) * turn.transpose();
    return;
  }
  const auto n = body.numbers("Ine", "_ne", 10);
  if (n.empty()) return;
  const Pose frame = pose_of(n, body.offset_of("Ine", "_ne"));
  const Matrix3 turn = frame.orientation.toRotationMatrix();
  shape.centre_of_mass = frame.position;
  shape.inertia = turn * Eigen::Vector3d(n[7], n[8], n[9]).asDiagonal() * turn.transpose();
}

void read_color(const TagList& color, Part& part) {
  if (const auto n = color.numbers("Cl3", "", 15); !n.empty()) {
    part.color = {n[0], n[1], n[2]};
    part.emission = {n[9], n[10], n[11]};
  } else if (const auto old = color.numbers("Cl2", "", 15); !old.empty()) {
    part.color = {old[3], old[4], old[5]};
    part.emission = {old[9], old[10], old[11]};
  } else if (const auto oldest = color.numbers("Cls", "", 12); !oldest.empty()) {
    part.color = {oldest[3], oldest[4], oldest[5]};
    part.emission = {oldest[9], oldest[10], oldest[11]};
  }
  const bool is_translucent = (color.u8("Var").value_or(4) & 4U) == 0;
  if (is_translucent) part.opacity = std::clamp(color.number("Trf", "").value_or(1), 0.0, 1.0);
}

class ShapeReader {
 public:
  ShapeReader(Shape& shape, ShapeSources& sources) : shape_(shape), sources_(sources) {}

  void read(const TagList& list) {
    const unsigned bits = list.u8("Sss").value_or(0);
    shape_.is_static = (bits & 0x80U) == 0;
    shape_.is_respondable = (list.u8("Ss3").value_or(list.u8("Ss2").value_or(0)) & 1U) != 0;
    shape_.respondable_mask = list.u16("Dc2").value_or(0xffff);
    const std::vector<double> velocity = list.numbers("Idv", "_dv", 6);
    if (velocity.size() == 6) {
      shape_.velocity = {velocity[0], velocity[1], velocity[2]};
      shape_.angular_velocity = {velocity[3], velocity[4], velocity[5]};
    }
    const TagList geometry = list.list("Ge2");
    if (auto mesh = geometry.item("Gst")) read_mesh(*mesh, true);
    if (auto compound = geometry.item("Gsg")) read_compound(*compound, true, 0);
    if (auto mesh = list.item("Geo"); mesh && geometry.items().empty()) read_mesh(*mesh, true);  // of V2.6.6
    if (shape_.parts.empty()) shape_.is_static = true;  // it would fall through all others
    if (const TagList material = list.list("Mat"); !material.items().empty()) read_material(material);
  }

 private:
  void read_outermost(const TagList& body, std::size_t offset) {
    const double mass = body.number("Mas", "_as").value_or(0);
    note_damage(body.damage(), [&] { require_sane(mass, 0, kMostMass, "the mass", offset); });
    shape_.mass = mass > 0 && mass <= kMostMass ? mass : kLeastMass;
    note_damage(body.damage(), [&] {
      read_inertia(body, shape_);
      if (shape_.centre_of_mass.cwiseAbs().maxCoeff() <= kMostSize) return;
      shape_.centre_of_mass = Vector3();
      fail_at(offset, "the centre of mass is out of range");
    });
  }

  void read_compound(Bytes bytes, bool is_outermost, int depth) {
    const std::size_t start = bytes.offset();
    if (depth > kDeepest) fail_at(start, "compounds are nested more than 64 deep: the file is damaged");
    const TagList body(bytes);
    if (is_outermost) read_outermost(body, start);
    read_old_material(body);
    for (const Item& item : body.items()) {
      if (item.tag == "Geo") read_mesh(item.content, false);
      if (item.tag == "Wrp") note_damage(body.damage(), [&] { read_compound(item.content, false, depth + 1); });
    }
  }

  void read_mesh(Bytes bytes, bool is_outermost) {
    const std::size_t start = bytes.offset();
    const TagList body(bytes);
    const TagList mesh(bytes);
    if (is_outermost) read_outermost(body, start);
    read_old_material(body);
    Part part;
    note_damage(mesh.damage(), [&] { find_arrays(mesh, part, start); });
    part.frame = mesh.position_first("Ppf", "_pf").value_or(Pose());
    if (!(part.frame.position.norm() <= kMostSize)) part.frame.position = Vector3();
    part.is_convex = (mesh.u8("Va2").value_or(0) & 1U) != 0 || (body.u8("Var").value_or(0) & 4U) != 0;
    const unsigned look = mesh.u8("Var").value_or(0);
    part.is_wireframe = (look & 4U) != 0;
    part.is_one_sided = (look & 2U) != 0;
    note_damage(mesh.damage(), [&] { read_primitive(mesh, part); });
    read_color(mesh.list("Cl0"), part);
    note_damage(mesh.damage(), [&] { read_texture(mesh.list("Toj"), part); });
    shape_.parts.push_back(std::move(part));
  }

  void find_arrays(const TagList& mesh, Part& part, std::size_t start) {
    static const auto no_vertices = std::make_shared<const Vertices>();
    static const auto no_triangles = std::make_shared<const Triangles>();
    part.vertices = no_vertices;
    part.triangles = no_triangles;
    MeshData own;
    own.add(mesh);
    auto vertices = own.vertices.empty() ? no_vertices : own.vertices.front();
    auto triangles = own.triangles.empty() ? no_triangles : own.triangles.front();
    if (const auto index = mesh.integer("Vev")) vertices = shared(sources_.meshes.vertices, *index, start);
    if (const auto index = mesh.integer("Inv")) triangles = shared(sources_.meshes.triangles, *index, start);
    if (triangles->size() > sources_.triangles_left) fail_at(start, "the file has more than 20 million triangles");
    for (const auto& triangle : *triangles) {
      for (const std::uint32_t corner : triangle) {
        if (corner >= vertices->size()) fail_at(start, "a triangle has a corner that is no vertex of its mesh");
      }
    }
    for (const auto& vertex : *vertices) {
      for (const float number : vertex) {
        if (std::abs(number) > kMostSize / 2) fail_at(start, "a vertex is more than 50 km from its shape: no mesh");
      }
    }
    const auto is_wide = [&](const auto& triangle) { return has_area(*vertices, triangle); };
    if (!triangles->empty() && std::none_of(triangles->begin(), triangles->end(), is_wide)) {
      fail_at(start, "the mesh has no triangle with an area");
    }
    sources_.triangles_left -= triangles->size();
    part.vertices = std::move(vertices);
    part.triangles = std::move(triangles);
  }

  template <class Array>
  static std::shared_ptr<const Array> shared(const std::vector<std::shared_ptr<const Array>>& arrays, int index,
                                             std::size_t start) {
    if (index < 0 || static_cast<std::size_t>(index) >= arrays.size()) {
      fail_at(start, "the mesh refers to the array " + std::to_string(index) + " of the file, which has " +
                         std::to_string(arrays.size()));
    }
    return arrays[static_cast<std::size_t>(index)];
  }

  static void read_primitive(const TagList& mesh, Part& part) {
    const bool are_doubles = mesh.has("_pr");
    auto bytes = mesh.item(are_doubles ? "_pr" : "Ppr");
    if (!bytes) return;
    const std::size_t start = bytes->offset();
    const int kind = bytes->i32();
    if (kind < 0 || kind > static_cast<int>(PrimitiveKind::kCapsule)) return;  // a later kind is a mesh
    const std::vector<double> size = bytes->numbers(3, are_doubles);
    for (const double length : size) require_sane(length, -kMostSize, kMostSize, "the size of a primitive", start);
    part.primitive = static_cast<PrimitiveKind>(kind);
    part.size = {size[0], size[1], size[2]};
    part.has_hole = mesh.number("Pp2", "_p2").value_or(0) > 0;
  }

  static void read_texture(const TagList& texture, Part& part) {
    constexpr unsigned kDecal = 1;
    const bool are_doubles = texture.has("_ob");
    auto bytes = texture.item(are_doubles ? "_ob" : "Tob");
    if (!bytes) return;
    part.texture = bytes->i32();
    part.is_decal = static_cast<unsigned>(texture.integer("Apm", 0)) == kDecal;
    auto coordinates = texture.item("Ftc");
    const std::size_t corners = coordinates ? coordinates->left() / (2 * sizeof(float)) : 0;
    if (corners == 0) {
      Projection projection;
      projection.mode = static_cast<ProjectionMode>(bytes->i32());
      const std::vector<double> size = bytes->numbers(2, are_doubles);
      projection.size = {size[0], size[1]};
      projection.frame = texture.rotation_first("Trc", "_rc").value_or(Pose());
      const unsigned bits = texture.u8("Bs2").value_or(0);
      projection.repeats = {(bits & 4U) != 0, (bits & 8U) != 0};
      part.texture_coordinates = projected(part, projection);
      return;
    }
    if (corners != 3 * part.triangles->size()) return;  // of another mesh: the colour remains
    std::vector<std::array<float, 2>> read(corners);
    for (auto& corner : read) {
      for (float& number : corner) number = static_cast<float>(coordinates->f32());
    }
    part.texture_coordinates = std::move(read);
  }

  void read_material(const TagList& material) {
    shape_.ode = material.block("OdN", "_dN");
    shape_.bullet = material.block("BuN", "_uN");
    if (!shape_.ode.empty()) return;
    if (auto old = material.item("Od2")) {
      note_damage(material.damage(), [&] {
        old->i32();
        shape_.ode = old->numbers(5, false);
      });
    }
  }

  void read_old_material(const TagList& body) {
    const auto id = body.integer("Dmi");
    if (!id || !shape_.ode.empty()) return;
    if (const auto found = sources_.materials.find(*id); found != sources_.materials.end())
      read_material(found->second);
  }

  Shape& shape_;
  ShapeSources& sources_;
};

}  // namespace

Shape read_shape(const TagList& list, ShapeSources& sources) {
  Shape shape;
  ShapeReader(shape, sources).read(list);
  return shape;
}

}  // namespace bubblesim::ttt
