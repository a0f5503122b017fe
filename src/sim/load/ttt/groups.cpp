// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/groups.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace bubblesim::ttt {
namespace {

class Grouping {
 public:
  Grouping(const SceneFile& file, const Structure& structure) : file_(file), structure_(structure) {}

  std::vector<Group> build() {
    find_tops();
    // One entry for each body, then one for each object at the top, which stands for what does not move below it.
    const std::size_t bodies = structure_.bodies.size();
    leader_.resize(bodies + file_.objects.size());
    std::iota(leader_.begin(), leader_.end(), std::size_t{0});
    for (const Connection& connection : structure_.connections) {
      const auto child = static_cast<std::size_t>(connection.child);
      if (connection.parent != kWorld) {
        unite(static_cast<std::size_t>(connection.parent), child);
      } else if (const int parent = node(connection.object).parent;
                 connection.kind != ConnectionKind::kWeld && parent != kNone) {
        unite(bodies + static_cast<std::size_t>(top(parent)), child);
      }
    }
    for (std::size_t i = 0; i < bodies; ++i) group(find(i)).bodies.push_back(static_cast<int>(i));
    for (int i = 0; i < static_cast<int>(file_.objects.size()); ++i) {
      if (node(i).body != kWorld) continue;
      Group& with = group(find(bodies + static_cast<std::size_t>(top(i))));
      with.fixed = top(i);
      with.members.push_back(i);
    }
    for (int i = 0; i < static_cast<int>(structure_.connections.size()); ++i) {
      const auto child = static_cast<std::size_t>(structure_.connections[static_cast<std::size_t>(i)].child);
      group(find(child)).connections.push_back(i);
    }
    std::vector<Group> groups;
    for (auto& [leader, found] : groups_) {
      put_at_zero(found);
      groups.push_back(std::move(found));
    }
    return groups;
  }

 private:
  const Node& node(int i) const { return structure_.nodes[static_cast<std::size_t>(i)]; }
  int top(int i) const { return tops_[static_cast<std::size_t>(i)]; }
  Group& group(std::size_t leader) { return groups_[leader]; }

  void find_tops() {
    tops_.resize(file_.objects.size());
    std::vector<int> open = structure_.roots;
    for (const int root : open) tops_[static_cast<std::size_t>(root)] = root;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (const int child : node(i).children) {
        tops_[static_cast<std::size_t>(child)] = top(i);
        open.push_back(child);
      }
    }
  }

  std::size_t find(std::size_t i) {
    while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    leader_[std::max(a, b)] = std::min(a, b);
  }

  const Pose& in_file(int body) const { return node(structure_.bodies[static_cast<std::size_t>(body)].shape).world; }

  /// Poses of the bodies with all joints at 0, from parents to children; empty if the connections form a loop.
  void put_at_zero(Group& group) {
    std::map<int, Pose>& poses = group.at_zero;
    const auto connection = [&](int i) -> const Connection& {
      return structure_.connections[static_cast<std::size_t>(i)];
    };
    const auto pose_of = [&](int body) { return body == kWorld ? Pose() : poses.at(body); };
    std::vector<int> left = group.connections;
    std::set<int> children;
    for (const int i : left) children.insert(connection(i).child);
    for (const int body : group.bodies) {
      if (children.count(body) == 0) poses.emplace(body, in_file(body));  // nothing leads to it: it stays
    }
    for (bool moved = true; moved;) {
      moved = false;
      for (auto i = left.begin(); i != left.end();) {
        const Connection& next = connection(*i);
        if (next.parent != kWorld && poses.count(next.parent) == 0) {
          ++i;
          continue;
        }
        const Pose parent_in_file = next.parent == kWorld ? Pose() : in_file(next.parent);
        const Node& joint = node(next.object);
        const bool turns =
            file_.objects[static_cast<std::size_t>(next.object)].as<Joint>() != nullptr &&
            file_.objects[static_cast<std::size_t>(next.object)].as<Joint>()->type != JointType::kSpherical;
        const Pose at = pose_of(next.parent) * (parent_in_file.inverse() * joint.world);
        const Pose child = turns ? at * (joint.moving.inverse() * in_file(next.child))
                                 : at * (joint.world.inverse() * in_file(next.child));
        if (!poses.emplace(next.child, child).second) {  // a loop
          poses.clear();
          return;
        }
        i = left.erase(i);
        moved = true;
      }
    }
    if (!left.empty() || poses.size() < group.bodies.size()) poses.clear();
  }

  const SceneFile& file_;
  const Structure& structure_;
  std::vector<int> tops_;
  std::vector<std::size_t> leader_;
  std::map<std::size_t, Group> groups_;
};

}  // namespace

std::vector<Group> groups_of(const SceneFile& file, const Structure& structure) {
  return Grouping(file, structure).build();
}

}  // namespace bubblesim::ttt
