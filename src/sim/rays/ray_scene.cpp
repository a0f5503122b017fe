// SPDX-License-Identifier: BSD-3-Clause
#include "rays/ray_scene.hpp"

#include <algorithm>
#include <array>

#include "rays/housing.hpp"
#include "rays/packet_math.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim {
namespace {

using namespace rays;

constexpr unsigned kPlaneInstance = RTC_INVALID_GEOMETRY_ID - 1;  // marks hits on planes_

QueryContext make_context(bool coherent, ObjectId ignored) {
  QueryContext context;
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  context.ignored_model = ignored;
  return context;
}

VisualDescription as_visual(const CollisionDescription& collision) {
  VisualDescription visual;
  visual.pose = collision.pose;
  visual.geometry = collision.geometry;
  return visual;
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

struct RayScene::InfinitePlane {
  const RayShape* shape;
  PlaneEquation equation;
};

struct RayScene::MovingLink {
  ObjectId id = kNoObject;
  Pose pose;
  LinkFrame frame;  // of the same pose
  bool placed = false;
  SceneHandle scene;
  GeometryHandle instance;
  std::vector<const RayShape*> shapes;  // by geometry id
};

struct RayScene::ModelShapes {
  std::vector<std::unique_ptr<RayShape>> shapes;
  std::vector<unsigned> statics;
  std::vector<unsigned> instances;
  std::vector<std::unique_ptr<MovingLink>> links;
};

// Of all build qualities and flags, these commit a scene of instances fastest: twice as fast as the lowest quality.
RayScene::RayScene()
    : statics_(make_scene(RTC_BUILD_QUALITY_HIGH)),
      housings_(make_scene(RTC_BUILD_QUALITY_HIGH)),
      movers_(make_scene(RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_DYNAMIC)) {
  rtcCommitScene(statics_.get());
  rtcCommitScene(housings_.get());
  rtcCommitScene(movers_.get());
}

RayScene::~RayScene() = default;

void RayScene::add_model(const World& world, ObjectId model, const ModelDescription& description) {
  auto placed = std::make_unique<ModelShapes>();
  const bool visuals = std::any_of(description.links.begin(), description.links.end(),
                                   [](const LinkDescription& link) { return !link.visuals.empty(); });
  const std::vector<ObjectId> ids = world.tree().parts(model, ObjectKind::kLink);
  const std::vector<Vector3> sensors = sensor_positions(world, model);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const LinkDescription& link = description.links[i];
    const Pose link_pose = world.pose(ids[i]);
    const Pose pose = description.is_static ? link_pose : Pose::Zero;
    const std::size_t first = placed->shapes.size();
    const auto add = [&](const VisualDescription& visual) {
      const Pose in_frame = pose * visual.pose;
      const ignition::math::Matrix3d turn(in_frame.Rot());
      placed->shapes.push_back(std::make_unique<RayShape>(
          RayShape{visual.geometry, in_frame, turn, turn.Transposed(), visual.material, visual.keeps_mesh_materials,
                   visual.cast_shadows, static_cast<float>(visual.laser_retro), ids[i], model,
                   houses(visual.geometry, link_pose * visual.pose, sensors)}));
      has_retro_ = has_retro_ || visual.laser_retro != 0;
    };
    if (visuals) {
      for (const VisualDescription& visual : link.visuals) add(visual);
    } else {
      for (const CollisionDescription& collision : link.collisions) add(as_visual(collision));
    }
    if (placed->shapes.size() == first) continue;
    if (description.is_static) {
      add_static(*placed, first);
    } else {
      add_moving(*placed, first, ids[i]);
    }
  }
  models_[model] = std::move(placed);
}

void RayScene::add_static(ModelShapes& model, std::size_t first) {
  for (std::size_t i = first; i < model.shapes.size(); ++i) {
    const RayShape& shape = *model.shapes[i];
    if (const auto* plane = std::get_if<Plane>(&shape.geometry)) {
      const Vector3 normal = shape.pose.Rot().RotateVector(plane->normal.Normalized());
      planes_.push_back({&shape, {normal, normal.Dot(shape.pose.Pos())}});
      continue;
    }
    const GeometryHandle geometry = make_geometry(shape);
    auto id = static_cast<unsigned>(static_shapes_.size());
    if (free_ids_.empty()) {
      static_shapes_.push_back(nullptr);
    } else {
      id = free_ids_.back();
      free_ids_.pop_back();
    }
    if (is_traced_as_round(shape) && shape.houses_sensor) {
      rtcAttachGeometryByID(housings_.get(), geometry.get(), id);
      housing_shapes_.push_back(&shape);
    } else {
      rtcAttachGeometryByID(statics_.get(), geometry.get(), id);
    }
    static_shapes_[id] = &shape;
    model.statics.push_back(id);
    statics_changed_ = true;
  }
}

void RayScene::add_moving(ModelShapes& model, std::size_t first, ObjectId link) {
  auto moving = std::make_unique<MovingLink>();
  moving->id = link;
  moving->scene = make_scene(RTC_BUILD_QUALITY_MEDIUM);
  for (std::size_t i = first; i < model.shapes.size(); ++i) {
    if (is_infinite(model.shapes[i]->geometry)) continue;  // a moving plane is an error of the scene check
    rtcAttachGeometry(moving->scene.get(), make_geometry(*model.shapes[i]).get());
    moving->shapes.push_back(model.shapes[i].get());
  }
  rtcCommitScene(moving->scene.get());
  moving->instance.reset(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(moving->instance.get(), moving->scene.get());
  const unsigned id = rtcAttachGeometry(movers_.get(), moving->instance.get());
  links_.resize(std::max<std::size_t>(links_.size(), id + 1));
  links_[id] = moving.get();
  model.instances.push_back(id);
  model.links.push_back(std::move(moving));
  movers_changed_ = true;
}

void RayScene::remove_model(ObjectId model) {
  const auto found = models_.find(model);
  if (found == models_.end()) return;
  for (const unsigned id : found->second->statics) {
    const auto housing = std::find(housing_shapes_.begin(), housing_shapes_.end(), static_shapes_[id]);
    rtcDetachGeometry(housing == housing_shapes_.end() ? statics_.get() : housings_.get(), id);
    if (housing != housing_shapes_.end()) housing_shapes_.erase(housing);
    static_shapes_[id] = nullptr;
    free_ids_.push_back(id);
    statics_changed_ = true;
  }
  for (const unsigned id : found->second->instances) {
    rtcDetachGeometry(movers_.get(), id);
    links_[id] = nullptr;
    movers_changed_ = true;
  }
  const auto gone = [model](const InfinitePlane& plane) { return plane.shape->model == model; };
  planes_.erase(std::remove_if(planes_.begin(), planes_.end(), gone), planes_.end());
  models_.erase(found);
}

void RayScene::refresh(const World& world) {
  for (MovingLink* link : links_) {
    if (link == nullptr) continue;
    const Pose pose = world.pose(link->id);
    if (pose == link->pose && link->placed) continue;
    link->pose = pose;
    link->frame = {ignition::math::Matrix3d(pose.Rot()), pose.Pos()};
    link->placed = true;
    const std::array<float, 12> matrix = to_matrix(link->frame);
    rtcSetGeometryTransform(link->instance.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix.data());
    rtcCommitGeometry(link->instance.get());
    movers_changed_ = true;
  }
  if (statics_changed_) rtcCommitScene(statics_.get());
  if (statics_changed_) rtcCommitScene(housings_.get());
  if (movers_changed_) rtcCommitScene(movers_.get());
  if (statics_changed_ || movers_changed_) check_embree();
  statics_changed_ = movers_changed_ = false;
}

/// Whether no ray can hit a housing: there is none, or all rays start in all of them.
bool RayScene::starts_in_housings(const RayPacket& packet, const QueryContext& context) const {
  if (housing_shapes_.empty()) return true;
  if ((context.embree.flags & RTC_INTERSECT_CONTEXT_FLAG_COHERENT) == 0) return false;
  const RTCRay16& ray = packet.data.ray;
  const Vector3 start(ray.org_x[0], ray.org_y[0], ray.org_z[0]);
  return std::all_of(housing_shapes_.begin(), housing_shapes_.end(), [&](const RayShape* shape) {
    return is_inside(shape->turn_back * (start - shape->pose.Pos()), shape->geometry);
  });
}

void RayScene::trace_once(RayPacket& packet, const RayMask& mask, QueryContext& context) const {
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    if (planes_[p].shape->model == context.ignored_model) continue;
    meet_plane(planes_[p].equation, static_cast<unsigned>(p), kPlaneInstance, mask, packet.data);
  }
  rtcIntersect16(mask.use, statics_.get(), &context.embree, &packet.data);
  if (!starts_in_housings(packet, context)) {
    rtcIntersect16(mask.use, housings_.get(), &context.embree, &packet.data);
  }
  if (!links_.empty()) rtcIntersect16(mask.use, movers_.get(), &context.embree, &packet.data);
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
    const Vector3 normal = links_[hit.instID[0][i]]->frame.turn * Vector3(hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]);
    if (normal.Dot(Vector3(ray.dir_x[i], ray.dir_y[i], ray.dir_z[i])) <= 0) continue;
    inside.use[i] = any = kUsed;
  }
  return any != 0;
}

void RayScene::trace(RayPacket& packet, bool coherent, ObjectId ignored) const {
  QueryContext context = make_context(coherent, ignored);
  if (ignored != kNoObject) context.embree.filter = keep_seen_hits;
  alignas(64) std::array<float, kPacket> far;
  std::copy_n(packet.data.ray.tfar, kPacket, far.begin());
  trace_once(packet, packet.mask, context);
  RayMask inside;
  if (ignored != kNoObject || !seen_from_inside(packet, inside)) return;
  // Only a ray that starts inside a shape gets here: trace again and reject each such hit.
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (inside.use[i] == 0) continue;
    packet.data.ray.tfar[i] = far[i];
    packet.data.hit.geomID[i] = packet.data.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  context.embree.filter = keep_seen_hits;
  trace_once(packet, inside, context);
}

void RayScene::occlude(RTCRay16& rays, const RayMask& mask) const {
  // Incoherent: with Embree's coherent flag an occlusion query may not return.
  QueryContext context = make_context(false, kNoObject);
  rtcOccluded16(mask.use, statics_.get(), &context.embree, &rays);
  if (!housing_shapes_.empty()) rtcOccluded16(mask.use, housings_.get(), &context.embree, &rays);
  if (!links_.empty()) rtcOccluded16(mask.use, movers_.get(), &context.embree, &rays);
}

const RayShape& RayScene::shape(const RayPacket& packet, std::size_t i) const {
  const unsigned geometry = packet.data.hit.geomID[i];
  const unsigned instance = packet.data.hit.instID[0][i];
  if (instance == kPlaneInstance) return *planes_[geometry].shape;
  if (instance == RTC_INVALID_GEOMETRY_ID) return *static_shapes_[geometry];
  return *links_[instance]->shapes[geometry];
}

Vector3 RayScene::normal(const RayPacket& packet, std::size_t i) const {
  const RTCHit16& hit = packet.data.hit;
  if (hit.instID[0][i] == kPlaneInstance) return planes_[hit.geomID[i]].equation.normal;
  const Vector3 normal = Vector3(hit.Ng_x[i], hit.Ng_y[i], hit.Ng_z[i]).Normalized();
  if (hit.instID[0][i] == RTC_INVALID_GEOMETRY_ID) return normal;
  return links_[hit.instID[0][i]]->frame.turn * normal;
}

const LinkFrame* RayScene::link_frame(const RayPacket& packet, std::size_t i) const {
  const unsigned instance = packet.data.hit.instID[0][i];
  return instance < kPlaneInstance ? &links_[instance]->frame : nullptr;
}

const Vector3* RayScene::plane_normal(const RayPacket& packet, std::size_t i) const {
  const RTCHit16& hit = packet.data.hit;
  return hit.instID[0][i] == kPlaneInstance ? &planes_[hit.geomID[i]].equation.normal : nullptr;
}

}  // namespace bubblesim
