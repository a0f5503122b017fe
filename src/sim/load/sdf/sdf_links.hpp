// SPDX-License-Identifier: BSD-3-Clause
// SDFormat's <link>, with the shapes and sensors in it.
#pragma once

#include <sdf/Link.hh>
#include <string>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"

namespace bubblesim {

/// `model_path` is the path of the model's object; `is_static` is that of the model.
LinkDescription read_link(const sdf::Link& link, const std::string& model_path, bool is_static, LoadContext& reading);

}  // namespace bubblesim
