// SPDX-License-Identifier: BSD-3-Clause
// Places in a tree that is not the nesting of the file, and objects without physics.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/scene.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The <bubblesim:place> of an element.
std::optional<TreePlace> read_place(const SdfElement& element);

/// The <bubblesim:object>s of a model or world at `path`.
std::vector<FrameDescription> read_objects(const SdfElement& owner, const std::string& path, LoadContext& context);

/// The <bubblesim:collection>s of a world.
std::vector<CollectionDescription> read_collections(const SdfElement& world, LoadContext& context);

}  // namespace bubblesim
