// SPDX-License-Identifier: BSD-3-Clause
// A slow renderer in double precision, written from the documented model of cameras and light, to compare pictures
// with. It shares only the exact intersections of single shapes with the simulator.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/scene.hpp"
#include "bubblesim/sensor_kinds.hpp"
#include "bubblesim/triangle_mesh.hpp"
#include "rays/ray_shapes.hpp"

namespace bubblesim::test {

/// What a pixel must show.
struct ReferencePixel {
  Vector3 rgb;                                             ///< 0 to 1
  double depth = std::numeric_limits<double>::infinity();  ///< m along the axis
  std::size_t object = 0;  ///< 1 + the index of the model, 0: none; every model has one link
};

class ReferencePicture {
 public:
  /// `description`: models of one link at its model's origin; `camera` looks along x of `pose`.
  ReferencePicture(const SceneDescription& description, CameraDescription camera, const Pose& pose)
      : environment_(description.environment), camera_(std::move(camera)), pose_(pose) {
    for (std::size_t i = 0; i < description.models.size(); ++i) {
      const ModelDescription& model = description.models[i];
      for (const VisualDescription& visual : model.links.at(0).visuals) {
        shapes_.push_back({visual, model.pose * visual.pose, i + 1});
      }
    }
  }

  /// `column` and `row` in pixels from the upper left corner of the image; a pixel's centre is at half a pixel.
  ReferencePixel at(double column, double row) const {
    const double focal = camera_.width / (2 * std::tan(camera_.horizontal_fov / 2));
    const Vector3 along(1, (camera_.width / 2.0 - column) / focal, (camera_.height / 2.0 - row) / focal);
    const Vector3 direction = pose_.orientation * along;
    const std::optional<Hit> hit = nearest({pose_.position, direction.normalized()}, camera_.near * direction.norm(),
                                           camera_.far * direction.norm());
    if (!hit) return {background(direction)};
    return {shade(*hit), hit->distance / direction.norm(), hit->shape->object};
  }

  /// The mean of four rays, as with antialias.
  Vector3 of_four(int column, int row) const {
    Vector3 sum;
    for (const double right : {0.25, 0.75}) {
      for (const double down : {0.25, 0.75}) sum += at(column + right, row + down).rgb / 4;
    }
    return sum;
  }

 private:
  struct Shape {
    VisualDescription visual;
    Pose pose;
    std::size_t object;
  };
  struct Hit {
    const Shape* shape;
    double distance;
    Vector3 place;   // world
    Vector3 inside;  // the same in the shape's frame
    Vector3 normal;  // for shading, in the shape's frame
    std::array<double, 2> texture = {0, 0};
  };

  static Vector3 rgb(const Color& color) { return {color.r, color.g, color.b}; }

  std::optional<Hit> nearest(const Ray& ray, double from, double to) const {
    std::optional<Hit> found;
    for (const Shape& shape : shapes_) {
      const Ray own{shape.pose.orientation.conjugate() * (ray.origin - shape.pose.position),
                    shape.pose.orientation.conjugate() * ray.direction};
      const auto hit = intersect(own, shape.visual.geometry, to);
      if (!hit || hit->distance < from || (found && hit->distance >= found->distance)) continue;
      found = Hit{&shape, hit->distance, ray.origin + ray.direction * hit->distance,
                  own.origin + own.direction * hit->distance, hit->normal};
    }
    if (found) complete(*found);
    return found;
  }

  /// Texture coordinates, and smooth normals of meshes.
  static void complete(Hit& hit) {
    if (const auto* box = std::get_if<Box>(&hit.shape->visual.geometry)) {
      const Vector3 part = hit.inside.cwiseQuotient(box->size);
      const Vector3& n = hit.normal;
      if (std::abs(n.x()) > 0.5) hit.texture = {(n.x() > 0 ? 1 : -1) * part.y() + 0.5, part.z() + 0.5};
      if (std::abs(n.y()) > 0.5) hit.texture = {(n.y() > 0 ? -1 : 1) * part.x() + 0.5, part.z() + 0.5};
      if (std::abs(n.z()) > 0.5) hit.texture = {(n.z() > 0 ? -1 : 1) * part.y() + 0.5, part.x() + 0.5};
    }
    const auto* mesh = std::get_if<Mesh>(&hit.shape->visual.geometry);
    if (mesh == nullptr) return;
    const TriangleMesh& known = *mesh->triangles;
    for (const TriangleMesh::Triangle& triangle : known.triangles) {
      const Vector3 a = known.corner(triangle, 0);
      const Vector3 ab = known.corner(triangle, 1) - a;
      const Vector3 ac = known.corner(triangle, 2) - a;
      const Vector3 normal = ab.cross(ac);
      const Vector3 ap = hit.inside - a;
      if (std::abs(normal.normalized().dot(ap)) > 1e-9) continue;
      const double v = ap.cross(ac).dot(normal) / normal.squaredNorm();
      const double w = ab.cross(ap).dot(normal) / normal.squaredNorm();
      if (v < -1e-9 || w < -1e-9 || v + w > 1 + 1e-9) continue;
      const std::array<double, 3> parts = {1 - v - w, v, w};
      if (!known.texture_coordinates.empty()) {
        hit.texture = {0, 0};
        for (std::size_t corner = 0; corner < 3; ++corner) {
          for (std::size_t axis = 0; axis < 2; ++axis) {
            hit.texture[axis] += parts[corner] * known.texture_coordinates[triangle[corner]][axis];
          }
        }
      }
      if (known.normals.empty()) return;
      hit.normal = {};
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const TriangleMesh::Point& n = known.normals[triangle[corner]];
        hit.normal += Vector3(n[0], n[1], n[2]) * parts[corner];
      }
      hit.normal.normalize();
      return;
    }
  }

  Vector3 diffuse(const Hit& hit) const {
    const Material& material = hit.shape->visual.material;
    const bool has_place = !std::holds_alternative<Plane>(hit.shape->visual.geometry);
    if (material.texture != nullptr && has_place) return texel(*material.texture, hit.texture);
    if (material.checker_size <= 0) return rgb(material.diffuse);
    double squares = 0;
    for (int axis = 0; axis < 3; ++axis) {
      squares += std::floor(hit.inside[axis] / material.checker_size + 5e-7);
    }
    return rgb(std::fmod(squares, 2) == 0 ? material.diffuse : material.checker_color);
  }

  /// Bilinear between the centres of the pixels of an image that repeats.
  static Vector3 texel(const Texture& texture, const std::array<double, 2>& place) {
    const double x = (place[0] - std::floor(place[0])) * texture.width - 0.5;
    const double y = (1 - place[1] - std::floor(1 - place[1])) * texture.height - 0.5;
    const auto pixel = [&](double column, double row) -> Vector3 {
      const int c = (static_cast<int>(column) + texture.width) % texture.width;
      const int r = (static_cast<int>(row) + texture.height) % texture.height;
      const std::uint8_t* bytes = &texture.rgb.at(3 * static_cast<std::size_t>(r * texture.width + c));
      return Vector3(bytes[0], bytes[1], bytes[2]) / 255;
    };
    const double left = std::floor(x);
    const double upper = std::floor(y);
    const Vector3 top = pixel(left, upper) * (1 - x + left) + pixel(left + 1, upper) * (x - left);
    const Vector3 bottom = pixel(left, upper + 1) * (1 - x + left) + pixel(left + 1, upper + 1) * (x - left);
    return top * (1 - y + upper) + bottom * (y - upper);
  }

  Vector3 background(const Vector3& direction) const {
    if (!environment_.sky) return rgb(environment_.background);
    const double up = std::sqrt(std::max(direction.normalized().z(), 0.0));
    return Vector3(0.85, 0.9, 0.95) * (1 - up) + Vector3(0.35, 0.55, 0.85) * up;
  }

  Vector3 shade(const Hit& hit) const {
    const Vector3 surface = diffuse(hit);
    const Vector3 normal = hit.shape->pose.orientation * hit.normal;
    Vector3 sum = rgb(hit.shape->visual.material.emissive) + surface.cwiseProduct(rgb(environment_.ambient));
    for (const Light& light : environment_.lights) {
      const bool directional = light.kind == LightKind::kDirectional;
      const Vector3 way = directional ? Vector3(-light.direction) : light.position - hit.place;
      const double distance = directional ? 1e3 : way.norm();
      const Vector3 to_light = way.normalized();
      const double cosine = normal.dot(to_light);
      if (cosine <= 0 || (!directional && distance > light.range)) continue;
      if (environment_.shadows && light.cast_shadows && is_shaded(hit.place + normal * 2e-4, to_light, distance)) {
        continue;
      }
      sum += surface.cwiseProduct(rgb(light.diffuse)) *
             (cosine * (directional ? 1 : brightness(light, distance, to_light)));
    }
    return sum;
  }

  static double brightness(const Light& light, double distance, const Vector3& to_light) {
    const double fading = light.constant_attenuation + light.linear_attenuation * distance +
                          light.quadratic_attenuation * distance * distance;
    if (light.kind != LightKind::kSpot) return 1 / fading;
    const double cosine = -to_light.dot(light.direction.normalized());
    const double outer = std::cos(light.outer_angle / 2);
    const double inner = std::cos(light.inner_angle / 2);
    return std::pow(std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0), light.falloff) / fading;
  }

  bool is_shaded(const Vector3& place, const Vector3& to_light, double distance) const {
    return std::any_of(shapes_.begin(), shapes_.end(), [&](const Shape& shape) {
      if (!shape.visual.cast_shadows || std::holds_alternative<Plane>(shape.visual.geometry)) return false;
      const Ray own{shape.pose.orientation.conjugate() * (place - shape.pose.position),
                    shape.pose.orientation.conjugate() * to_light};
      return intersect(own, shape.visual.geometry, distance).has_value();
    });
  }

  Environment environment_;
  CameraDescription camera_;
  Pose pose_;
  std::vector<Shape> shapes_;
};

}  // namespace bubblesim::test
