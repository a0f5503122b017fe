// SPDX-License-Identifier: BSD-3-Clause
// The image of a pinhole, or of parallel rays, with depth and visible objects. The centre of pixel (column, row) is at
// column + 0.5, row + 0.5 from the upper left corner; the optical axis is at the centre of the image.
#pragma once

#include <memory>

#include "bubblesim/sensor_definition.hpp"

namespace bubblesim {

/// `id`: the object whose pose is that of the camera, which looks along x, with y to the left and z up.
std::unique_ptr<Sensor> make_camera(const CameraDescription& description, const Environment& environment, ObjectId id);

}  // namespace bubblesim
