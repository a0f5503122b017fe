// SPDX-License-Identifier: BSD-3-Clause
// A kind of joint, in one object: what the reader of files, the check and the physics know of it. Each kind has a file
// in src/sim/physics/joints; registry.cpp there lists them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/scene.hpp"

struct dxWorld;  // ODE's

namespace bubblesim {

class Checker;
class Joint;
class LoadContext;
class SdfElement;
struct JointSite;

class JointKind {
 public:
  virtual ~JointKind() = default;
  JointKind(const JointKind&) = delete;
  JointKind& operator=(const JointKind&) = delete;

  const char* name;  ///< of SDFormat
  int axes;
  bool is_hinge = false;        ///< rotates about its one axis, and does nothing else
  bool slides = false;          ///< along its axis, without rotation
  bool swings = false;          ///< inertia alone determines its rotation, unless its axes have motors
  bool has_limits = true;       ///< of the positions of its axes
  bool couples_hinges = false;  ///< of its parent and child with a reference body

  /// Reads the elements that only this kind has, and completes axes that files omit. The path is that of the joint
  /// in messages.
  virtual void read(const SdfElement&, const std::string& /*path*/, LoadContext&, JointDescription&) const {}
  /// Reports what cannot be simulated, besides limits that are the same for all kinds.
  virtual void check(Checker&, const ModelDescription&, const JointDescription&) const {}
  /// Creates the joint in ODE.
  virtual std::unique_ptr<Joint> make(dxWorld* world, const JointDescription&, const JointSite&) const = 0;

 protected:
  JointKind(const char* name_, int axes_) : name(name_), axes(axes_) {}
};

/// All kinds; errors list them in this order.
const std::vector<const JointKind*>& joint_kinds();

/// Null when no kind has this name.
const JointKind* find_joint_kind(std::string_view name);

}  // namespace bubblesim
