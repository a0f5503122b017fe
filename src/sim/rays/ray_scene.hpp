// SPDX-License-Identifier: BSD-3-Clause
// The scene of all ray-traced sensors: the visuals in Embree, in single precision. Static models are traced directly;
// each moving link, and each link of a static model that was ever moved, is an instance, moved only when a sensor
// measures. Rays hit surfaces from outside only, so a sensor
// inside its own housing sees through it. Geometries are shared with the other simulations of a scene.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <unordered_map>
#include <vector>

#include "bubblesim/prepared_scene.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/world.hpp"
#include "rays/faces_in_light.hpp"
#include "rays/faces_in_view.hpp"
#include "rays/packet_math.hpp"
#include "rays/prepared_rays.hpp"
#include "rays/ray_packet.hpp"
#include "rays/ray_shape.hpp"
#include "scene/transform.hpp"

namespace bubblesim {

class RayScene {
 public:
  RayScene();
  /// The models of a scene; prepared at the first refresh().
  explicit RayScene(std::shared_ptr<const Scene> scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Adds the shapes of the model with the handle `model`.
  void add_model(const World& world, ObjectId model, const ModelDescription& description);
  void remove_model(ObjectId model);

  /// Updates the poses of moving links. Cheap when nothing moved.
  void refresh(const World& world);

  /// Finds the nearest surface for each used ray, ignoring the model `ignored`. `coherent`: all rays start at one
  /// point, and neighbouring rays are nearly parallel.
  void trace(rays::RayPacket& packet, bool coherent, ObjectId ignored = kNoObject) const;
  /// The same in two parts, for coherent rays that start where they did before: what does not move needs to be traced
  /// once, until fixed_version() changes. `cone` is around the rays, `far` their end before the first part.
  void trace_fixed(rays::RayPacket& packet) const;
  void trace_moving(rays::RayPacket& packet, const rays::Cone& cone, float far) const;
  /// Whether the second part can find anything.
  bool may_meet_moving(const rays::Cone& cone) const;
  /// Another number whenever what does not move has changed, and in each scene.
  std::uint64_t fixed_version() const { return fixed_version_; }
  /// The number of all shapes.
  std::size_t shape_count() const;
  /// Adds all shapes, with the ids of their hits.
  void collect(rays::FacesInView& view) const;
  void collect(rays::FacesInLight& light) const;
  /// Sets tfar of each ray with a hit to -infinity. Infinite planes cast no shadow.
  void occlude(RTCRay16& rays, const rays::RayMask& mask) const;

  /// Whether any shape ever had a laser_retro.
  bool has_retro() const { return has_retro_; }

  /// Replaces the materials of a link.
  void set_color(ObjectId link, const Color& color) { colors_[link] = color; }
  /// The colour that was set for a link; null if none was.
  const Color* color(ObjectId link) const {
    const auto found = colors_.find(link);
    return found != colors_.end() ? &found->second : nullptr;
  }

  /// The shape that ray `i` of a traced packet hit; the ray must have a hit.
  const rays::RayShape& shape(const rays::RayPacket& packet, std::size_t i) const;
  /// The surface normal at the hit; unit length, world axes.
  Vector3 normal(const rays::RayPacket& packet, std::size_t i) const;
  /// The frame of the moving link that ray `i` hit; null if the hit is on a static shape.
  const Transform* link_frame(const rays::RayPacket& packet, std::size_t i) const;
  /// The normal of the infinite plane that ray `i` hit; null if the hit is on another shape.
  const Vector3* plane_normal(const rays::RayPacket& packet, std::size_t i) const;

 private:
  struct MovingLink;

  template <class Take>
  void for_each_shape(const Take& take) const;
  void place(rays::SharedRayModel model);
  void place_links(const rays::RayModel& model);
  void loosen(const World& world, ObjectId link);
  void place_scene(const SceneTree& tree);
  void note_fixed_change();
  void meet_fixed(rays::RayPacket& packet, const rays::RayMask& mask, rays::QueryContext& context) const;
  void meet_moving(rays::RayPacket& packet, const rays::RayMask& mask, const rays::Cone& cone,
                   rays::QueryContext& context) const;
  bool restart_seen_from_inside(rays::RayPacket& packet, const rays::PacketFloats& far, rays::RayMask& inside,
                                rays::QueryContext& context) const;
  void add_moving(rays::RayPacket& packet, const rays::Cone& cone, const rays::PacketFloats& far,
                  rays::QueryContext& context) const;
  bool starts_in_housings(const rays::RayPacket& packet, const rays::QueryContext& context) const;
  bool seen_from_inside(const rays::RayPacket& packet, rays::RayMask& inside) const;

  std::shared_ptr<const Scene> scene_;  // null when its models are placed
  std::vector<rays::SharedRayModel> models_;
  std::vector<rays::SharedRayModel> loosened_;  // the links of static models that were moved
  std::set<ObjectId> loose_;                    // the same links
  std::vector<rays::RayModel::InfinitePlane> planes_;
  std::shared_ptr<const rays::StaticRays> statics_;
  rays::SceneHandle movers_;                        // null without moving links
  std::vector<std::unique_ptr<MovingLink>> links_;  // by instance id; null where one was removed
  std::uint64_t fixed_version_ = 0;
  bool statics_changed_ = true;
  bool movers_changed_ = false;
  bool has_retro_ = false;
  std::unordered_map<ObjectId, Color> colors_;  // by link; of removed links, too, whose handles do not come back soon
};

}  // namespace bubblesim
