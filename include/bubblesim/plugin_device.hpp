// SPDX-License-Identifier: BSD-3-Clause
// A device in a library of the user, which a <plugin> of a model names.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "bubblesim/device.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/math.hpp"
#include "bubblesim/scene.hpp"
#include "bubblesim/scene_tree.hpp"

namespace bubblesim {

/// States the file and line of an element of a <plugin>.
struct PluginParameterError : InvalidInput {
  using InvalidInput::InvalidInput;
};

/// The elements in a <plugin>. Functions without a default throw PluginParameterError when an element is missing, all
/// of them when its text cannot be read. What is never read is reported as unknown.
class PluginParameters {
 public:
  explicit PluginParameters(const PluginDescription& plugin) : plugin_(plugin) {}

  /// Without surrounding whitespace.
  std::string text(const std::string& name) const;
  std::string text(const std::string& name, const std::string& fallback) const;
  /// Finite.
  double number(const std::string& name) const;
  double number(const std::string& name, double fallback) const;
  /// true, false, 1 or 0.
  bool flag(const std::string& name, bool fallback) const;
  /// Three finite numbers.
  Vector3 vector(const std::string& name, const Vector3& fallback) const;

  /// Returns the error for an element, or for one that is missing, with its place.
  PluginParameterError error(const std::string& name, const std::string& problem) const;

  /// With all nested elements.
  const PluginDescription& plugin() const { return plugin_; }
  /// The names that were read so far.
  const std::set<std::string>& names_read() const { return names_read_; }

 private:
  const PluginParameter* find(const std::string& name) const;
  const PluginParameter& required(const std::string& name) const;
  double number_in(const PluginParameter& parameter) const;

  const PluginDescription& plugin_;
  mutable std::set<std::string> names_read_;
};

/// What a device finds when it is loaded. The parameters are valid during load() only.
struct PluginPlace {
  World& world;
  ObjectId model;  ///< the outermost model that has the <plugin>
  ObjectId owner;  ///< that model, a nested one, or a sensor: where the <plugin> is
  const PluginParameters& parameters;
  std::string ros_namespace;  ///< <robotNamespace>, or that with which the model was added; empty: the root

  /// Returns a link or joint of the model, its name being the text of a parameter; throws PluginParameterError,
  /// with similar names, when the model has none of that name.
  ObjectId link(const std::string& parameter) const;
  ObjectId joint(const std::string& parameter) const;
};

/// Exported by PLUGINLIB_EXPORT_CLASS(mine::Device, bubblesim::PluginDevice). It is made with the model that names its
/// library, and destroyed with it. update(), reset() and transfer() are those of Device. After an exception of update()
/// or reset() the device is reported with its model, and not called any more.
class PluginDevice : public Device {
 public:
  PluginDevice() = default;
  ~PluginDevice() override;
  PluginDevice(const PluginDevice&) = delete;
  PluginDevice& operator=(const PluginDevice&) = delete;

  /// Reads the parameters and finds the parts of the model, before the first substep. After an exception the model runs
  /// without the device.
  virtual void load(const PluginPlace& place) = 0;
};

/// Calls a device until it throws.
class SwitchedDevice : public Device {
 public:
  explicit SwitchedDevice(std::shared_ptr<PluginDevice> device) : device_(std::move(device)) {}

  void update(World& world, double time, double duration) override;
  void reset(World& world) override;
  void transfer(StateArchive& archive) override { device_->transfer(archive); }

  /// What it threw; empty when it works.
  const std::string& failure() const { return failure_; }

 private:
  template <class Call>
  void guarded(const char* function, const Call& call);

  std::shared_ptr<PluginDevice> device_;
  std::string failure_;
};

}  // namespace bubblesim
