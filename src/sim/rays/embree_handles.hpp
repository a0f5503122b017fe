// SPDX-License-Identifier: BSD-3-Clause
// Owning handles for Embree's objects.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace bubblesim::rays {

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// Embree for this process, on the calling thread alone. Throws std::runtime_error when it cannot be had.
RTCDevice device();

/// Throws std::runtime_error when Embree noted an error on this thread.
void check_embree();

/// A scene that loses no ray between neighbouring faces.
SceneHandle make_scene(RTCBuildQuality quality);

}  // namespace bubblesim::rays
