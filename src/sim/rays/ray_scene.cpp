// SPDX-License-Identifier: BSD-3-Clause
#include "rays/ray_scene.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "rays/housing.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_shapes.hpp"
#include "scene/prepared.hpp"

namespace bubblesim {
namespace {

using namespace rays;

/// Up to as many moving links are looked at one by one; a scene of more of them repays its making.
constexpr std::size_t kFewLinks = 16;

constexpr unsigned kPlaneInstance = RTC_INVALID_GEOMETRY_ID - 1;  // marks hits on planes_

const Cone kAllAround{{}, {}, -1, 0};

QueryContext make_context(bool coherent, ObjectId ignored) {
  QueryContext context;
  context.embree.coherent = coherent;
  context.ignored_model = ignored;
  return context;
}

PacketFloats ends_of(const RayPacket& packet) {
  PacketFloats ends;
  std::copy_n(packet.data.ray.tfar, kPacket, ends.begin());
  return ends;
}

/// Rejects hits from inside and on the ignored model.
void keep_seen_hits(const RTCFilterFunctionNArguments* arguments) {
  const auto& shape = *static_cast<const RayShape*>(arguments->geometryUserPtr);
  const auto& context = *reinterpret_cast<const QueryContext*>(arguments->context);
  if (shape.model == context.ignored_model) {
    std::fill_n(arguments->valid, arguments->N, 0);
  } else {
    keep_hits_from_outside(arguments);
  }
}

}  // namespace

struct RayScene::MovingLink {
  const RayModel::Link* link;
  ObjectId model;
  Pose pose;
  Transform frame;  // of the same pose
  Vector3 middle;   // of its shapes, in the world
  bool placed = false;
  GeometryHandle instance;

  bool is_near(const RTCRay16& rays, const RayMask& mask, RayMask& near) const {
    return can_meet_sphere(rays, mask.use, middle, link->reach, near);
  }
  bool reaches_into(const Cone& cone) const { return rays::reaches_into(middle, link->reach, cone); }
};

RayScene::RayScene() = default;

RayScene::RayScene(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)) {}

RayScene::~RayScene() = default;

void RayScene::add_model(const World& world, ObjectId model, const ModelDescription& description) {
  if (scene_ != nullptr) place_scene(world.tree());
  place(prepare_rays(world.tree(), model, description));
}

/// Places the models of the scene that were not removed.
void RayScene::place_scene(const SceneTree& tree) {
  const PreparedRays& prepared = scene_->prepared().rays(*scene_);
  for (const SharedRayModel& model : prepared.models) {
    if (tree.contains(model->object)) place(model);
  }
  if (models_.size() == prepared.models.size()) {
    statics_ = prepared.statics;
    statics_changed_ = false;
  }
  scene_ = nullptr;
}

void RayScene::note_fixed_change() {
  static std::atomic<std::uint64_t> last{0};
  fixed_version_ = ++last;
}

void RayScene::place(SharedRayModel model) {
  planes_.insert(planes_.end(), model->planes.begin(), model->planes.end());
  note_fixed_change();
  statics_changed_ = statics_changed_ || !model->fixed.empty();
  has_retro_ = has_retro_ || std::any_of(model->shapes.begin(), model->shapes.end(),
                                         [](const auto& shape) { return shape->laser_retro != 0; });
  place_links(*model);
  models_.push_back(std::move(model));
}

void RayScene::place_links(const RayModel& model) {
  for (const RayModel::Link& link : model.links) {
    // Of all build qualities and flags, these commit a scene of instances fastest: twice as fast as the lowest quality.
    if (movers_ == nullptr) movers_ = make_scene(RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_DYNAMIC);
    auto moving = std::make_unique<MovingLink>();
    moving->link = &link;
    moving->model = model.object;
    moving->instance.reset(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(moving->instance.get(), link.scene.get());
    const unsigned id = rtcAttachGeometry(movers_.get(), moving->instance.get());
    links_.resize(std::max<std::size_t>(links_.size(), id + 1));
    links_[id] = std::move(moving);
    movers_changed_ = true;
  }
}

/// Takes a link out of the static shapes.
void RayScene::loosen(const World& world, ObjectId link) {
  const ObjectId object = world.tree().outermost_model_of(link);
  const auto model = std::find_if(models_.begin(), models_.end(),
                                  [object](const SharedRayModel& placed) { return placed->object == object; });
  if (model == models_.end()) return;
  const ModelDescription& description = world.models().description(link);
  const Pose pose = description.pose * description.links[world.tree().at(link).index].pose;
  loosened_.push_back(loosened(**model, link, pose));
  place_links(*loosened_.back());
  statics_changed_ = true;
  note_fixed_change();
}

void RayScene::remove_model(ObjectId model) {
  const auto found = std::find_if(models_.begin(), models_.end(),
                                  [model](const SharedRayModel& placed) { return placed->object == model; });
  if (found == models_.end()) return;
  for (std::size_t id = 0; id < links_.size(); ++id) {
    if (links_[id] == nullptr || links_[id]->model != model) continue;
    rtcDetachGeometry(movers_.get(), static_cast<unsigned>(id));
    links_[id] = nullptr;
    movers_changed_ = true;
  }
  const auto gone = [model](const RayModel::InfinitePlane& plane) { return plane.shape->model == model; };
  planes_.erase(std::remove_if(planes_.begin(), planes_.end(), gone), planes_.end());
  if (!(*found)->fixed.empty()) {
    statics_changed_ = true;
    statics_ = nullptr;  // refers to shapes of the model
  }
  note_fixed_change();
  models_.erase(found);
  loosened_.erase(std::remove_if(loosened_.begin(), loosened_.end(),
                                 [model](const SharedRayModel& loose) { return loose->object == model; }),
                  loosened_.end());
}

void RayScene::refresh(const World& world) {
  if (scene_ != nullptr) place_scene(world.tree());
  for (const ObjectId link : world.moved_statics()) {
    if (world.tree().contains(link) && loose_.insert(link).second) loosen(world, link);
  }
  for (const auto& link : links_) {
    if (link == nullptr) continue;
    const Pose pose = world.pose(link->link->id);
    if (link->placed && pose == link->pose) continue;
    link->pose = pose;
    link->frame = Transform(pose);
    link->middle = link->frame * link->link->middle;
    link->placed = true;
    Eigen::Matrix<float, 3, 4> matrix;
    matrix << link->frame.rotation.cast<float>(), link->frame.position.cast<float>();
    rtcSetGeometryTransform(link->instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix.data());
    rtcCommitGeometry(link->instance.get());
    movers_changed_ = true;
  }
  // Sensors on several threads call this: it writes only what changed.
  if (statics_changed_) {
    statics_ = gather_statics(models_, loose_);
    statics_changed_ = false;
  }
  if (movers_changed_ && links_.size() > kFewLinks) {
    rtcCommitScene(movers_.get());
    check_embree();
    movers_changed_ = false;
  }
}

/// Whether no ray can hit a housing: there is none, or all rays start in all of them.
bool RayScene::starts_in_housings(const RayPacket& packet, const QueryContext& context) const {
  const std::vector<const RayShape*>& housings = statics_->housing_shapes;
  if (housings.empty()) return true;
  if (!context.embree.coherent) return false;
  const RTCRay16& ray = packet.data.ray;
  const Vector3 start(ray.org_x[0], ray.org_y[0], ray.org_z[0]);
  return std::all_of(housings.begin(), housings.end(), [&](const RayShape* shape) {
    return is_inside(shape->turn_back * (start - shape->pose.position), shape->geometry);
  });
}

void RayScene::meet_fixed(RayPacket& packet, const RayMask& mask, QueryContext& context) const {
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    if (planes_[p].shape->model == context.ignored_model) continue;
    meet_plane(planes_[p].equation, static_cast<unsigned>(p), kPlaneInstance, mask, packet.data);
  }
  intersect_packet(mask.use, statics_->scene.get(), context.embree, packet.data);
  if (!starts_in_housings(packet, context)) {
    intersect_packet(mask.use, statics_->housings.get(), context.embree, packet.data);
  }
}

void RayScene::meet_moving(RayPacket& packet, const RayMask& mask, const Cone& cone, QueryContext& context) const {
  if (links_.size() > kFewLinks) return intersect_packet(mask.use, movers_.get(), context.embree, packet.data);
  for (std::size_t id = 0; id < links_.size(); ++id) {
    if (links_[id] == nullptr) continue;
    const MovingLink& link = *links_[id];
    RayMask near;
    if (!link.reaches_into(cone) || !link.is_near(packet.data.ray, mask, near)) continue;
    RTCRayHit16 turned;
    into_frame(link.frame.rotation, link.frame.position, packet.data.ray, turned);
    intersect_packet(near.use, link.link->scene.get(), context.embree, turned);
    take_hits(turned, static_cast<unsigned>(id), near, packet.data);
  }
}

/// Marks the rays that hit a face from inside.
bool RayScene::seen_from_inside(const RayPacket& packet, RayMask& inside) const {
  const RTCRay16& ray = packet.data.ray;
  const RTCHit16& hit = packet.data.hit;
  int moving = 0;
  int any = hits_from_inside(packet.data, packet.mask, kPlaneInstance, inside, moving);
  if (moving == 0) return any != 0;
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (packet.mask.use[i] == 0 || hit.instID[0][i] >= kPlaneInstance) continue;
    const Vector3 normal = links_[hit.instID[0][i]]->frame.rotation * Vector3(hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]);
    if (normal.dot(Vector3(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i])) <= 0) continue;
    inside.use[i] = any = kUsed;
  }
  return any != 0;
}

/// Marks the rays that start inside a shape, and lets them start again without hits from inside.
bool RayScene::restart_seen_from_inside(RayPacket& packet, const PacketFloats& far, RayMask& inside,
                                        QueryContext& context) const {
  if (!seen_from_inside(packet, inside)) return false;
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (inside.use[i] == 0) continue;
    packet.data.ray.tfar[i] = far[i];
    packet.data.hit.geomID[i] = packet.data.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  context.embree.filter = keep_seen_hits;
  return true;
}

/// Adds what moves to a packet that has met what does not.
void RayScene::add_moving(RayPacket& packet, const Cone& cone, const PacketFloats& far, QueryContext& context) const {
  meet_moving(packet, packet.mask, cone, context);
  RayMask inside;
  if (context.ignored_model != kNoObject || !restart_seen_from_inside(packet, far, inside, context)) return;
  meet_fixed(packet, inside, context);
  meet_moving(packet, inside, cone, context);
}

void RayScene::trace(RayPacket& packet, bool coherent, ObjectId ignored) const {
  QueryContext context = make_context(coherent, ignored);
  if (ignored != kNoObject) context.embree.filter = keep_seen_hits;
  const PacketFloats far = ends_of(packet);
  Cone cone = kAllAround;
  if (coherent && !links_.empty() && links_.size() <= kFewLinks) cone = cone_around(packet.data.ray, packet.mask);
  meet_fixed(packet, packet.mask, context);
  add_moving(packet, cone, far, context);
}

void RayScene::trace_fixed(RayPacket& packet) const {
  QueryContext context = make_context(true, kNoObject);
  const PacketFloats far = ends_of(packet);
  meet_fixed(packet, packet.mask, context);
  RayMask inside;
  if (restart_seen_from_inside(packet, far, inside, context)) meet_fixed(packet, inside, context);
}

void RayScene::trace_moving(RayPacket& packet, const Cone& cone, float far) const {
  QueryContext context = make_context(true, kNoObject);
  PacketFloats ends;
  ends.fill(far);
  add_moving(packet, cone, ends, context);
}

bool RayScene::may_meet_moving(const Cone& cone) const {
  if (links_.size() > kFewLinks) return true;
  return std::any_of(links_.begin(), links_.end(),
                     [&](const auto& link) { return link != nullptr && link->reaches_into(cone); });
}

/// Calls `take` with each finite shape, its frame (null: the world), and the geometry and instance of its hits.
template <class Take>
void RayScene::for_each_shape(const Take& take) const {
  for (std::size_t i = 0; i < statics_->shapes.size(); ++i) {
    take(*statics_->shapes[i], nullptr, static_cast<unsigned>(i), RTC_INVALID_GEOMETRY_ID);
  }
  for (std::size_t id = 0; id < links_.size(); ++id) {
    if (links_[id] == nullptr) continue;
    const std::vector<const RayShape*>& shapes = links_[id]->link->shapes;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      take(*shapes[i], &links_[id]->frame, static_cast<unsigned>(i), static_cast<unsigned>(id));
    }
  }
}

std::size_t RayScene::shape_count() const {
  std::size_t count = planes_.size() + statics_->shapes.size();
  for (const auto& link : links_) count += link != nullptr ? link->link->shapes.size() : 0;
  return count;
}

void RayScene::collect(FacesInView& view) const {
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    view.add(planes_[p].equation, static_cast<unsigned>(p), kPlaneInstance);
  }
  for_each_shape([&](const RayShape& shape, const Transform* frame, unsigned geometry, unsigned instance) {
    view.add(shape, frame, geometry, instance);
  });
  view.sort();
}

void RayScene::collect(FacesInLight& light) const {
  for_each_shape([&](const RayShape& shape, const Transform* frame, unsigned, unsigned) { light.add(shape, frame); });
  light.arrange();
}

void RayScene::occlude(RTCRay16& rays, const RayMask& mask) const {
  QueryContext context = make_context(false, kNoObject);
  occlude_packet(mask.use, statics_->scene.get(), context.embree, rays);
  if (!statics_->housing_shapes.empty()) occlude_packet(mask.use, statics_->housings.get(), context.embree, rays);
  if (links_.size() > kFewLinks) return occlude_packet(mask.use, movers_.get(), context.embree, rays);
  for (const auto& link : links_) {
    RayMask near;
    if (link == nullptr || !link->is_near(rays, mask, near)) continue;
    RTCRayHit16 turned;
    into_frame(link->frame.rotation, link->frame.position, rays, turned);
    occlude_packet(near.use, link->link->scene.get(), context.embree, turned.ray);
    std::copy_n(turned.ray.tfar, kPacket, rays.tfar);
  }
}

const RayShape& RayScene::shape(const RayPacket& packet, std::size_t i) const {
  const unsigned geometry = packet.data.hit.geomID[i];
  const unsigned instance = packet.data.hit.instID[0][i];
  if (instance == kPlaneInstance) return *planes_[geometry].shape;
  if (instance == RTC_INVALID_GEOMETRY_ID) return *statics_->shapes[geometry];
  return *links_[instance]->link->shapes[geometry];
}

Vector3 RayScene::normal(const RayPacket& packet, std::size_t i) const {
  const RTCHit16& hit = packet.data.hit;
  if (hit.instID[0][i] == kPlaneInstance) return planes_[hit.geomID[i]].equation.normal;
  const Vector3 normal = Vector3(hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]).normalized();
  if (hit.instID[0][i] == RTC_INVALID_GEOMETRY_ID) return normal;
  return links_[hit.instID[0][i]]->frame.rotation * normal;
}

const Transform* RayScene::link_frame(const RayPacket& packet, std::size_t i) const {
  const unsigned instance = packet.data.hit.instID[0][i];
  return instance < kPlaneInstance ? &links_[instance]->frame : nullptr;
}

const Vector3* RayScene::plane_normal(const RayPacket& packet, std::size_t i) const {
  const RTCHit16& hit = packet.data.hit;
  return hit.instID[0][i] == kPlaneInstance ? &planes_[hit.geomID[i]].equation.normal : nullptr;
}

}  // namespace bubblesim
