// SPDX-License-Identifier: BSD-3-Clause
#include "graph/names.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace bubblesim::ros2 {
namespace {

bool is_word(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
         letter == '_';
}

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// Why a name is not one of ROS 2; empty if it is one (design.ros2.org/articles/topic_and_service_names.html).
std::string problem_of(std::string_view name) {
  if (name.empty()) return "it is empty";
  if (name.front() == '~') {
    name.remove_prefix(1);
    if (name.empty()) return "it has no name part";
    if (name.front() != '/') return "'~' must be followed by '/'";
  }
  if (name.size() > 1 && name.back() == '/') return "it ends with '/'";
  if (name == "/") return "it has no name part";
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_word(name[i]) && name[i] != '/') return std::string("character '") + name[i] + "' is not allowed";
    if (name[i] != '/') continue;
    if (i + 1 < name.size() && name[i + 1] == '/') return "it has an empty part";
    if (i + 1 < name.size() && is_digit(name[i + 1])) return "a part begins with a digit";
  }
  return is_digit(name.front()) ? "it begins with a digit" : "";
}

void check(const std::string& name, const std::string& kind) {
  const std::string problem = problem_of(name);
  if (!problem.empty()) throw std::invalid_argument("invalid " + kind + " name '" + name + "': " + problem);
}

/// `~a` is ROS 1's spelling of `~/a`.
std::string with_slash(const std::string& name) {
  return name.size() > 1 && name[0] == '~' && name[1] != '/' ? "~/" + name.substr(1) : name;
}

std::string dds_type(const std::string& type, const std::string& folder, const std::string& ending) {
  const std::size_t first = type.find('/');
  const std::size_t last = type.rfind('/');  // parts of actions have their folder in the name: `pkg/action/Type_Goal`
  const std::string place = first == last ? folder : type.substr(first + 1, last - first - 1);
  return type.substr(0, first) + "::" + place + "::dds_::" + type.substr(last + 1) + ending + "_";
}

/// The inverse of dds_type(); a type without `middle` and `ending` stays.
std::string ros_type(const std::string& type, std::string_view middle, std::string_view ending) {
  const std::size_t place = type.find(middle);
  const bool ends =
      type.size() > ending.size() && type.compare(type.size() - ending.size(), ending.size(), ending) == 0;
  if (place == std::string::npos || !ends) return type;
  const std::size_t begin = place + middle.size();
  return type.substr(0, place) + "/" + type.substr(begin, type.size() - ending.size() - begin);
}

}  // namespace

Names::Names(int& argc, char** argv, const std::string& default_name) : node_(default_name) {
  std::vector<std::pair<std::string, std::string>> given;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::size_t sign = argument.find(":=");
    if (sign == std::string::npos || sign == 0) {
      argv[kept++] = argv[i];
      continue;
    }
    const std::string name = argument.substr(0, sign);
    const std::string value = argument.substr(sign + 2);
    if (name == "__name" || name == "__node") {
      node_ = value;
    } else if (name == "__ns") {
      space_ = value.empty() || value.front() != '/' ? "/" + value : value;
    } else if (name.rfind("__", 0) == 0) {
      continue;  // ROS 1's alone: __master, __log
    } else if (name.front() == '_') {
      parameters_[name.substr(1)] = value;
    } else {
      given.emplace_back(name, value);
    }
  }
  if (argc > 0) argc = kept;
  if (argv != nullptr) argv[argc] = nullptr;
  if (node_.find('/') != std::string::npos) {
    throw std::invalid_argument("invalid name for the ROS node: '" + node_ + "' has a '/'");
  }
  check(node_, "node");
  if (space_ != "/") check(space_, "namespace");
  for (const auto& [name, value] : given) {
    check(with_slash(name), "remapped");
    check(with_slash(value), "remapped");
    replacements_[expand(with_slash(name))] = expand(with_slash(value));
  }
}

std::string Names::below(const std::string& space, const std::string& name) {
  return space == "/" ? "/" + name : space + "/" + name;
}

std::string Names::expand(const std::string& name) const {
  if (name.front() == '/') return name;
  if (name.front() == '~') return full_node() + name.substr(1);
  return below(space_, name);
}

std::string Names::resolve(const std::string& name, const std::string& kind) const {
  const std::string spelt = with_slash(name);
  check(spelt, kind);
  const std::string full = expand(spelt);
  const auto replaced = replacements_.find(full);
  return replaced == replacements_.end() ? full : replaced->second;
}

TopicName message_topic(const std::string& topic, const messages::MessageType& type) {
  return {"rt" + topic, dds_type(type.name, "msg", ""), type.type_hash};
}

TopicName request_topic(const std::string& service, const messages::ServiceType& type) {
  return {"rq" + service + "Request", dds_type(type.name, "srv", "_Request"), type.type_hash};
}

TopicName reply_topic(const std::string& service, const messages::ServiceType& type) {
  return {"rr" + service + "Reply", dds_type(type.name, "srv", "_Response"), type.type_hash};
}

std::string message_of(const std::string& type) { return ros_type(type, "::msg::dds_::", "_"); }

std::string service_of(const std::string& request_type) { return ros_type(request_type, "::srv::dds_::", "_Request_"); }

}  // namespace bubblesim::ros2
