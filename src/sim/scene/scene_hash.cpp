// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_hash.hpp"

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "bubblesim/sensor_definition.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "scene/fnv1a.hpp"

namespace bubblesim {
namespace {

/// Adds descriptions, member by member.
class DescriptionHash {
 public:
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number> || std::is_enum_v<Number>>>
  void add(Number number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof number);
    hash_.add(bits);
  }
  void add(const std::string& text) { hash_.add(std::string_view(text)); }
  void add(const Vector3& v) { (*this)(v.x(), v.y(), v.z()); }
  void add(const Quaternion& q) { (*this)(q.w(), q.x(), q.y(), q.z()); }
  void add(const Pose& p) { (*this)(p.position, p.orientation); }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(values.size());
    if constexpr (std::is_trivially_copyable_v<Value> && std::has_unique_object_representations_v<Value>) {
      add_bytes(values.data(), values.size() * sizeof(Value));
    } else {
      for (const Value& value : values) add(value);
    }
  }
  template <class Value, std::size_t kCount>
  void add(const std::array<Value, kCount>& values) {
    for (const Value& value : values) add(value);
  }
  template <class Value>
  void add(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <class... Kinds>
  void add(const std::variant<Kinds...>& value) {
    add(value.index());
    std::visit([this](const auto& kind) { this->add(kind); }, value);
  }
  void add_bytes(const void* data, std::size_t size) {
    hash_.add(std::string_view(static_cast<const char*>(data), size));
  }

  void add(const Box& box) { add(box.size); }
  void add(const Sphere& sphere) { add(sphere.radius); }
  void add(const Cylinder& cylinder) { (*this)(cylinder.radius, cylinder.length); }
  void add(const Capsule& capsule) { (*this)(capsule.radius, capsule.length); }
  void add(const Ellipsoid& ellipsoid) { add(ellipsoid.radii); }
  void add(const Plane& plane) { add(plane.normal); }
  void add(const Mesh& mesh) {
    const TriangleMesh& t = *mesh.triangles;
    (*this)(t.vertices, t.triangles, t.normals, t.texture_coordinates, t.materials, t.material_of);
  }
  void add(const Surface& s) {
    (*this)(s.mu, s.collide_bitmask, s.mu2, s.fdir1, s.slip1, s.slip2, s.torsion, s.torsion_by_depth, s.rolling, s.kp,
            s.kd, s.soft_erp, s.soft_cfm, s.restitution, s.bounce_threshold, s.max_vel, s.min_depth, s.max_contacts,
            s.collide_without_contact);
    if (s.own_bitmask) (*this)(*s.own_bitmask);
  }
  void add(const CollisionDescription& c) { (*this)(c.name, c.pose, c.geometry, c.surface, c.mesh_collision); }
  void add(const Color& c) { (*this)(c.r, c.g, c.b); }
  void add(const Material& m) {
    (*this)(m.diffuse, m.emissive, m.checker_size, m.checker_color, m.texture != nullptr);
    if (m.texture != nullptr) (*this)(m.texture->width, m.texture->height, m.texture->rgb);
  }
  void add(const VisualDescription& v) {
    (*this)(v.name, v.pose, v.geometry, v.material, v.keeps_mesh_materials, v.cast_shadows, v.laser_retro);
  }
  void add(const Light& l) {
    (*this)(l.direction, l.diffuse, l.cast_shadows, l.kind, l.position, l.range, l.constant_attenuation,
            l.linear_attenuation, l.quadratic_attenuation, l.inner_angle, l.outer_angle, l.falloff);
  }
  void add(const SensorKind& kind) {
    add(hash_number(definition_of(kind)));
    add_members(*kind.table(), kind.data());
  }
  void add_members(const MemberTable& table, const void* record) {
    for (const Member& member : table.members) {
      if (member.is_stored()) add_member(member, member.get(record));
    }
  }
  void add_member(const Member& member, const void* value) {
    switch (member.type) {
      case MemberType::kFlag:
        return add(*static_cast<const bool*>(value));
      case MemberType::kInteger:
      case MemberType::kChoice: {
        std::int32_t number = 0;
        std::memcpy(&number, value, sizeof number);
        return add(number);
      }
      case MemberType::kNumber:
        return add(*static_cast<const double*>(value));
      case MemberType::kText:
        return add(*static_cast<const std::string*>(value));
      case MemberType::kTexts:
        return add(*static_cast<const std::vector<std::string>*>(value));
      case MemberType::kVector:
        return add(*static_cast<const Vector3*>(value));
      case MemberType::kRotation:
        return add(*static_cast<const Quaternion*>(value));
      case MemberType::kBytes:
        return add(*static_cast<const std::vector<std::uint8_t>*>(value));
      case MemberType::kIntegers:
        return add(*static_cast<const std::vector<std::int32_t>*>(value));
      case MemberType::kFloats:
        return add(*static_cast<const std::vector<float>*>(value));
      case MemberType::kNumbers:
        return add(*static_cast<const std::vector<double>*>(value));
      case MemberType::kRecord:
      case MemberType::kRecords:
        return add_records(member.records, value);
    }
  }
  void add_records(const RecordList& list, const void* value) {
    const std::size_t size = list.size(value);
    if (list.resize != nullptr) add(size);
    for (std::size_t i = 0; i < size; ++i) add_members(list.table(), list.at(value, i));
  }
  void add(const PluginParameter& p) { (*this)(p.name, p.text, p.children); }
  void add(const PluginDescription& p) { (*this)(p.name, p.filename, p.parameters); }
  void add(const SensorDescription& s) { (*this)(s.name, s.type, s.pose, s.update_rate, s.kind, s.plugins); }
  void add(const LinkDescription& l) {
    (*this)(l.name, l.gravity_enabled, l.wind_enabled, l.linear_decay, l.angular_decay, l.pose, l.start, l.mass,
            l.centre_of_mass, l.inertia_diagonal, l.inertia_products, l.collisions, l.visuals, l.sensors, l.lights);
    if (!l.carrier.empty()) add(l.carrier);
    if (l.start_velocity) (*this)(l.start_velocity->linear, l.start_velocity->angular);
  }
  void add(const MimicDescription& m) { (*this)(m.joint, m.axis, m.multiplier, m.offset, m.reference); }
  void add(const AxisDescription& a) {
    (*this)(a.direction, a.lower, a.upper, a.max_force, a.max_velocity, a.friction, a.damping, a.spring_stiffness,
            a.spring_reference, a.motor, a.mimic);
    if (a.target != 0) (*this)(a.target);
    if (a.position_gain != kPositionGain) (*this)(a.position_gain);
    if (a.by_callback) (*this)(a.by_callback);
  }
  void add(const JointDescription& j) {
    (*this)(j.name, j.type, j.parent, j.child, j.pose, j.axes, j.sensors, j.screw_lead, j.gearbox_ratio,
            j.gearbox_reference);
  }
  void add(const NestedModelDescription& n) { (*this)(n.name, n.pose, n.canonical_link, n.plugins); }
  void add(const FrameDescription& f) {
    (*this)(f.name, f.link, f.pose);
    if (f.joint) (*this)(*f.joint, f.joint_position);
  }
  void add(const GripperDescription& g) { (*this)(g.palm, g.fingers, g.min_contacts, g.attach_steps, g.detach_steps); }
  void add(const Waypoint& w) { (*this)(w.time, w.pose); }
  void add(const Trajectory& t) { (*this)(t.tension, t.waypoints); }
  void add(const MotionScript& m) { (*this)(m.loop, m.delay, m.trajectories); }
  void add(const ModelDescription& m) {
    (*this)(m.name, m.pose, m.is_static, m.self_collide, m.canonical_link, m.links, m.joints, m.nested, m.plugins);
    if (!m.frames.empty()) add(m.frames);
    if (!m.grippers.empty()) add(m.grippers);
    if (m.script) add(*m.script);
  }
  void add(const Environment& e) {
    (*this)(e.ambient, e.background, e.sky, e.shadows, e.lights, e.origin.latitude, e.origin.longitude,
            e.origin.elevation, e.origin.heading, e.magnetic_field, e.wind);
  }
  void add(const RandomQuantity& r) {
    (*this)(r.name, r.distribution.kind, r.distribution.operation, r.distribution.first, r.distribution.second);
  }
  void add(const SceneDescription& s) {
    (*this)(s.gravity, s.time_step, s.substep, s.on_divergence, s.environment, s.models, s.plugins, s.randomized);
    if (!s.frames.empty()) add(s.frames);
    if (s.solver != Solver::kBubblesim) (*this)(s.solver);
  }

  Fnv1a hash_;
};

}  // namespace

std::uint64_t hash_of(const SceneDescription& scene) {
  DescriptionHash hash;
  hash(scene);
  return hash.value();
}

std::uint64_t hash_of(const ModelDescription& model) {
  DescriptionHash hash;
  hash(model);
  return hash.value();
}

}  // namespace bubblesim
