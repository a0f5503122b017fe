// SPDX-License-Identifier: BSD-3-Clause
#include "validation/needed_substep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "scene/joint_kind.hpp"

namespace bubblesim {
namespace {

constexpr double kTensions = 3;  // of a swing from the horizontal, in weights of the load

/// Whether nothing but inertia determines the rotation of a joint.
bool is_free(const JointDescription& joint) {
  const JointKind* kind = find_joint_kind(joint.type);
  if (kind == nullptr || !kind->swings) return false;
  return std::all_of(joint.axes.begin(), joint.axes.end(), [](const AxisDescription& axis) {
    return (axis.motor == MotorMode::kNone || axis.motor == MotorMode::kEffort) && !axis.mimic;
  });
}

/// The least moment of inertia about an axis across `along`, or that about the axis of a joint with one.
double moment_across(const LinkDescription& link, const Vector3& along, const JointDescription& joint) {
  const Matrix3 inertia = link.inertia();
  const Quaternion to_link = link.pose.orientation.conjugate();
  if (joint.axes.size() == 1) {
    const Vector3 axis = to_link * (joint.pose.orientation * joint.axes.front().direction);
    return axis.dot(inertia * axis);
  }
  const Vector3 u = to_link * along;
  const Vector3 e = u.unitOrthogonal();
  const Vector3 f = u.cross(e);
  const double ee = e.dot(inertia * e);
  const double ff = f.dot(inertia * f);
  return (ee + ff) / 2 - std::hypot((ee - ff) / 2, e.dot(inertia * f));
}

/// The links of a model as a tree whose root is the world, or the heaviest link.
class Hanging {
 public:
  explicit Hanging(const ModelDescription& model) : model_(model) {
    for (std::size_t i = 0; i < model.links.size(); ++i) index_[model.links[i].name] = i;
    at_.resize(model.links.size() + 1);  // the last is the world
    for (const JointDescription& joint : model.joints) {
      const std::size_t parent = place(joint.parent);
      const std::size_t child = place(joint.child);
      at_[parent].push_back({&joint, child});
      at_[child].push_back({&joint, parent});
    }
    order_from(at_.back().empty() ? heaviest() : model.links.size());
  }

  std::optional<NeededSubstep> needed(double gravity) const {
    std::optional<NeededSubstep> least;
    for (std::size_t i = 1; i < order_.size(); ++i) {
      const std::size_t link = order_[i].link;
      const JointDescription* above = order_[i].joint;
      if (link >= model_.links.size() || above == nullptr || !is_free(*above)) continue;
      for (const Edge& edge : at_[link]) {
        if (edge.joint == above || above_[edge.link] != edge.joint || !is_free(*edge.joint)) continue;
        const Vector3 apart = edge.joint->pose.position - above->pose.position;
        if (apart.norm() <= 0) continue;
        const double load = mass_[edge.link];
        const double moment = moment_across(model_.links[link], apart.normalized(), *above);
        const double step = 2 / std::sqrt(kTensions * gravity * load * apart.norm() / moment);
        if (!least || step < least->step) least = NeededSubstep{step, model_.links[link].name, load};
      }
    }
    return least;
  }

 private:
  struct Edge {
    const JointDescription* joint;
    std::size_t link;
  };

  std::size_t place(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? model_.links.size() : found->second;
  }

  std::size_t heaviest() const {
    const auto lighter = [](const LinkDescription& a, const LinkDescription& b) { return a.mass < b.mass; };
    return static_cast<std::size_t>(std::max_element(model_.links.begin(), model_.links.end(), lighter) -
                                    model_.links.begin());
  }

  void order_from(std::size_t root) {
    above_.assign(at_.size(), nullptr);
    mass_.assign(at_.size(), 0);
    std::vector<bool> seen(at_.size(), false);
    std::vector<std::size_t> under(at_.size(), root);
    order_.push_back({nullptr, root});
    seen[root] = true;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::size_t here = order_[i].link;
      for (const Edge& edge : at_[here]) {
        if (seen[edge.link]) continue;
        seen[edge.link] = true;
        above_[edge.link] = edge.joint;
        under[edge.link] = here;
        order_.push_back(edge);
      }
    }
    for (std::size_t i = order_.size(); i-- > 1;) {
      const std::size_t link = order_[i].link;
      if (link < model_.links.size()) mass_[link] += model_.links[link].mass;
      mass_[under[link]] += mass_[link];
    }
  }

  const ModelDescription& model_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::vector<Edge>> at_;           // by link
  std::vector<Edge> order_;                     // from the root outwards
  std::vector<const JointDescription*> above_;  // the joint towards the root
  std::vector<double> mass_;                    // of the link and all that hangs on it, kg
};

}  // namespace

std::optional<NeededSubstep> needed_substep(const ModelDescription& model, double gravity) {
  if (model.is_static || model.joints.size() < 2 || model.links.empty() || !(gravity > 0)) return std::nullopt;
  return Hanging(model).needed(gravity);
}

}  // namespace bubblesim
