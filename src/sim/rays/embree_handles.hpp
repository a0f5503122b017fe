// SPDX-License-Identifier: BSD-3-Clause
// Owning handles for Embree's objects.
#pragma once

#include <memory>
#include <type_traits>

#include "rays/embree.hpp"

namespace bubblesim::rays {

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};

using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// The Embree device of this process; it uses the calling thread only. Throws std::runtime_error when Embree is not
/// available.
RTCDevice device();

/// Throws std::runtime_error if Embree reported an error on this thread.
void check_embree();

/// Creates a scene in which no ray passes between neighbouring faces. `flag` is added to its flags.
SceneHandle make_scene(RTCBuildQuality quality, RTCSceneFlags flag = RTC_SCENE_FLAG_NONE);

}  // namespace bubblesim::rays
