// SPDX-License-Identifier: BSD-3-Clause
#include "rays/embree_handles.hpp"

#include <stdexcept>
#include <string>

namespace bubblesim::rays {

RTCDevice device() {
  // One thread: results do not depend on the number of threads, and no thread spins.
  static RTCDevice shared = rtcNewDevice("threads=1,set_affinity=0");  // never destroyed
  if (shared == nullptr) throw std::runtime_error("Embree cannot be initialized on this machine");
  return shared;
}

void check_embree() {
  const RTCError error = rtcGetDeviceError(device());
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

SceneHandle make_scene(RTCBuildQuality quality, RTCSceneFlags flag) {
  SceneHandle scene(rtcNewScene(device()));
  check_embree();
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST | kFilterOfQuery | flag);
  rtcSetSceneBuildQuality(scene.get(), quality);
  return scene;
}

}  // namespace bubblesim::rays
