// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "load/ttt/write_parts.hpp"
#include "load/ttt/xml_writer.hpp"

namespace bubblesim::ttt {
namespace {

constexpr unsigned kNotRespondable = 0x40;
constexpr unsigned kGroundBit = 0x100;  // above the eight bits of the masks
constexpr double kThickness = 0.01;     // m, of planes, which have none in the file
constexpr double kLeast = 1e-4;         // m, of a side

bool equal(double a, double b) { return std::abs(a - b) <= 1e-4 * std::max(std::abs(a), std::abs(b)); }

/// Whether the primitive is one of SDFormat's shapes. The others are meshes in the file, too.
bool is_plain(const Part& part) {
  const Vector3& s = part.size;
  if (part.has_hole) return false;
  switch (part.primitive) {
    case PrimitiveKind::kPlane:
      return s.x() > kLeast && s.y() > kLeast;
    case PrimitiveKind::kCuboid:
    case PrimitiveKind::kSpheroid:
      return s.minCoeff() > kLeast;
    case PrimitiveKind::kCylinder:
      return s.minCoeff() > kLeast && equal(s.x(), s.y());
    case PrimitiveKind::kCapsule:
      return s.minCoeff() > kLeast && equal(s.x(), s.y()) && s.z() > s.x();
    default:
      return false;
  }
}

/// A plane is solid below itself.
Pose plain_pose(const Part& part) {
  return part.primitive == PrimitiveKind::kPlane ? part.frame * Pose(0, 0, -kThickness / 2, 0, 0, 0) : part.frame;
}

/// `shrink`: of the radius of a cylinder.
void write_plain(pugi::xml_node geometry, const Part& part, double shrink = 1) {
  const Vector3& s = part.size;
  switch (part.primitive) {
    case PrimitiveKind::kSpheroid:
      if (equal(s.x(), s.y()) && equal(s.x(), s.z())) {
        put(geometry.append_child("sphere"), "radius", s.x() / 2);
      } else {
        put(geometry.append_child("ellipsoid"), "radii", exact({s.x() / 2, s.y() / 2, s.z() / 2}));
      }
      return;
    case PrimitiveKind::kCylinder: {
      pugi::xml_node cylinder = geometry.append_child("cylinder");
      put(cylinder, "radius", shrink * s.x() / 2);
      put(cylinder, "length", s.z());
      return;
    }
    case PrimitiveKind::kCapsule: {
      pugi::xml_node capsule = geometry.append_child("capsule");
      put(capsule, "radius", s.x() / 2);
      put(capsule, "length", s.z() - s.x());
      return;
    }
    default:
      put(geometry.append_child("box"), "size",
          exact({s.x(), s.y(), part.primitive == PrimitiveKind::kPlane ? kThickness : s.z()}));
  }
}

/// Of the material for the engine that the file used: Bullet has its own, the others that for ODE.
double friction_of(const Shape& shape, int engine) {
  constexpr std::size_t kOfBullet = 2;
  if (engine == 0 && shape.bullet.size() > kOfBullet) return std::max(shape.bullet[kOfBullet], 0.0);
  return shape.ode.empty() ? 1 : std::max(shape.ode.front(), 0.0);
}

/// The part of the velocity that `damping` takes in `seconds`, as a part in a step of Gazebo, which SDFormat has.
double decay_of(double damping, double seconds) {
  constexpr double kGazeboStep = 1e-3;  // s
  constexpr double kMost = 0.999;
  return -std::expm1(std::log1p(-std::clamp(damping, 0.0, kMost)) * kGazeboStep / seconds);
}

class ShapeWriter {
 public:
  ShapeWriter(pugi::xml_node link, int shape, const Pose& link_pose, const LinkKind& kind, Conversion& conversion)
      : link_(link),
        node_(conversion.node(shape)),
        shape_(*conversion.object(shape).as<Shape>()),
        name_(plain_name(conversion.object(shape).alias)),
        in_link_(link_pose.inverse() * node_.world),
        kind_(kind),
        conversion_(conversion) {}

  void write() {
    if (shape_.is_respondable && (node_.model_flags & kNotRespondable) == 0) {
      for (const Part& part : shape_.parts) write_collision(part);
    }
    if (node_.is_visible) write_visuals();
  }

 private:
  std::string next_name(const char* what) { return conversion_.names.take(name_ + "_" + what); }

  static bool has_mesh(const Part& part) { return !part.triangles->empty(); }

  /// `mask`: for other trees, `own`: for shapes of its own.
  pugi::xml_node collision(const Pose& pose, unsigned mask, unsigned own) {
    pugi::xml_node element = named(link_, "collision", next_name("collision"));
    put_pose(element, pose);
    pugi::xml_node surface = element.append_child("surface");
    put(surface.append_child("friction").append_child("ode"), "mu",
        friction_of(shape_, conversion_.file.settings.engine));
    pugi::xml_node contact = surface.append_child("contact");
    put(contact, "collide_bitmask", mask);
    if (!kind_.is_static) put(contact, "bubblesim:own_bitmask", own);
    return element;
  }

  void write_collision(const Part& part) {
    const unsigned mask = shape_.respondable_mask >> 8U;
    const unsigned own = shape_.respondable_mask & 0xffU;
    if (mask == 0 && own == 0) return;
    if (is_plain(part)) {
      const bool rolls =
          kind_.is_wheel && mask != 0 && part.primitive == PrimitiveKind::kCylinder && part.size.z() < part.size.x();
      constexpr double kWithinSphere = 0.96;
      pugi::xml_node element = collision(in_link_ * plain_pose(part), kind_.is_static ? mask | kGroundBit : mask, own);
      write_plain(element.append_child("geometry"), part, rolls ? kWithinSphere : 1);
      if (!rolls) return;
      // A cylinder scrubs along its width when a robot turns; a sphere of its radius rolls about one point.
      pugi::xml_node sphere =
          collision(in_link_ * part.frame, kGroundBit, 0).append_child("geometry").append_child("sphere");
      put(sphere, "radius", part.size.x() / 2);
    } else if (has_mesh(part)) {
      pugi::xml_node element = collision(in_link_, kind_.is_static ? mask | kGroundBit : mask, own);
      pugi::xml_node mesh = element.append_child("geometry").append_child("mesh");
      put(mesh, "uri", conversion_.meshes.write(name_ + "_collision", {&part}));
      const bool is_convex = part.is_convex || (!part.has_hole && (part.primitive == PrimitiveKind::kCylinder ||
                                                                   part.primitive == PrimitiveKind::kCone ||
                                                                   part.primitive == PrimitiveKind::kDisc));
      if (is_convex) put(element, "bubblesim:convex", "hull");
    }
  }

  void write_visuals() {
    // Meshes of one look are one visual.
    using Look = std::tuple<Rgb, Rgb, double, std::string>;
    std::map<Look, std::vector<const Part*>> meshes;
    for (const Part& part : shape_.parts) {
      if (part.is_wireframe) continue;  // its edges are on the faces of others
      const std::string texture = conversion_.meshes.texture(part);
      if (is_plain(part) && texture.empty()) {
        pugi::xml_node element = visual(in_link_ * plain_pose(part), part, texture);
        write_plain(element.append_child("geometry"), part);
      } else if (has_mesh(part)) {
        meshes[{part.color, part.emission, part.opacity, texture}].push_back(&part);
      }
    }
    for (const auto& [look, parts] : meshes) {
      pugi::xml_node element = visual(in_link_, *parts.front(), std::get<std::string>(look));
      put(element.append_child("geometry").append_child("mesh"), "uri",
          conversion_.meshes.write(name_ + "_visual", parts, true));
    }
  }

  pugi::xml_node visual(const Pose& pose, const Part& look, const std::string& texture) {
    pugi::xml_node element = named(link_, "visual", next_name("visual"));
    put_pose(element, pose);
    if (look.opacity < 1) put(element, "transparency", 1 - look.opacity);
    pugi::xml_node material = element.append_child("material");
    put(material, "diffuse", color_text(!texture.empty() && look.is_decal ? Rgb{1, 1, 1} : look.color));
    if (look.emission != Rgb{0, 0, 0}) put(material, "emissive", color_text(look.emission));
    if (!texture.empty()) put(material.append_child("pbr").append_child("metal"), "albedo_map", texture);
    return element;
  }

  pugi::xml_node link_;
  const Node& node_;
  const Shape& shape_;
  std::string name_;
  Pose in_link_;
  LinkKind kind_;
  Conversion& conversion_;
};

}  // namespace

void write_shape(pugi::xml_node link, int shape, const Pose& link_pose, const LinkKind& kind, Conversion& conversion) {
  ShapeWriter(link, shape, link_pose, kind, conversion).write();
}

void write_damping(pugi::xml_node link, const Shape& shape, const Settings& settings) {
  constexpr std::size_t kOfBlock = 3;  // linear, then angular, in the blocks of both engines
  const bool is_bullet = settings.engine == 0;
  const std::vector<double>& block = is_bullet ? shape.bullet : shape.ode;
  if (block.size() < kOfBlock + 2 || !(block[kOfBlock] > 0 || block[kOfBlock + 1] > 0)) return;
  // Bullet's damping is for a second, ODE's for a substep.
  const double seconds = is_bullet ? 1 : settings.engine_step;
  pugi::xml_node decay = link.append_child("velocity_decay");
  put(decay, "linear", decay_of(block[kOfBlock], seconds));
  put(decay, "angular", decay_of(block[kOfBlock + 1], seconds));
}

}  // namespace bubblesim::ttt
