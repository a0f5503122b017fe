// SPDX-License-Identifier: BSD-3-Clause
// The frames of a model or world, and the poses in them: SDFormat's frame semantics.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "bubblesim/math.hpp"
#include "load/load_context.hpp"
#include "load/sdf/elements/sdf_element.hpp"

namespace bubblesim {

/// The frames of one model: __model__, its links, joints and <frame>s, its nested models, and what is in those as
/// inner::name. Those of a world: its models and <frame>s. Poses are in the model's (world's) own frame. Each pose is
/// resolved once, in any order.
class Frames {
 public:
  /// Of a <model> or <world> at `path`. Reports frames that do not exist and cycles; poses relative to those are taken
  /// as relative to the model. `relative_to` of files before SDFormat 1.7, where it is `frame`, is a warning only.
  Frames(const SdfElement& owner, const std::string& path, LoadContext& context);
  /// Of a model from another source than SDFormat.
  explicit Frames(const ModelDescription& model);

  bool has(const std::string& name) const { return locate(name).has_value(); }
  /// The pose of a frame that exists.
  Pose pose(const std::string& name) const;
  /// The pose of an element in the frame of `carrier`, its default frame: __model__, or the link that has it.
  Pose pose_of(const SdfElement& element, const std::string& carrier, const std::string& path,
               LoadContext& context) const;

  /// The link that a frame is attached to, as inner::link; empty when there is none.
  std::string link_of(const std::string& name) const;
  /// The frames of a nested model.
  const Frames& inner(const std::string& name) const { return *inner_.at(name); }
  /// All frames, with those in nested models as inner::name.
  std::vector<std::string> names() const;

 private:
  struct Frame {
    Pose raw;              // in the frame `base`
    std::string base;      // empty: the model
    std::string attached;  // to this frame; of a link: empty
    bool is_link = false;
    Source source;
    bool tolerant = false;  // an unknown base is a warning
    mutable std::optional<Pose> resolved;
  };
  /// Where a name leads: to a frame of this model, and from there to one in the nested model of that name.
  struct Place {
    const Frame* frame = nullptr;  // null: the model itself
    std::string name;
    std::string rest;  // empty: the frame itself
  };

  void add(const std::string& name, Frame frame);
  void add_element(const SdfElement& element);
  void add_model(const SdfElement& model, const std::string& path, LoadContext& context);
  void check_bases(const std::string& path, LoadContext& context);
  std::optional<Place> locate(const std::string& name) const;
  std::string link_of(const std::string& name, std::size_t steps) const;

  std::unordered_map<std::string, Frame> frames_;
  std::vector<std::string> order_;  // names as in the file
  std::map<std::string, std::unique_ptr<Frames>> inner_;
  std::string canonical_link_;
};

/// The frame that the <pose> of an element is relative to, by its attribute; empty: the default.
std::string base_of(const SdfElement& element);

}  // namespace bubblesim
