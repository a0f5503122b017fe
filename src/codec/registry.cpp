// SPDX-License-Identifier: BSD-3-Clause
// Turns the generated tables into MessageType objects at the first query, and holds the types that are added later.
#include "bubblesim/messages/registry.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "message_tables.hpp"

namespace bubblesim::messages {
namespace {

template <class T>
T number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::logic_error("generated message tables: '" + std::string(text) + "' is not a number");
  }
  return value;
}

Constant make_constant(const tables::ConstantRow& row) {
  switch (row.kind) {
    case FieldKind::kString:
      return {row.name, std::string(row.value)};
    case FieldKind::kBool:
      return {row.name, number<int>(row.value) != 0};
    case FieldKind::kFloat32:
    case FieldKind::kFloat64:
      return {row.name, number<double>(row.value)};
    case FieldKind::kUint64:
      return {row.name, number<std::uint64_t>(row.value)};
    default:
      return {row.name, number<std::int64_t>(row.value)};
  }
}

/// `pkg/msg/Type` -> `pkg/Type`; other names stay unchanged.
std::string without_folder(std::string_view name, std::string_view folder) {
  const std::size_t slash = name.find('/');
  const bool has_folder = slash != name.npos && name.substr(slash + 1, folder.size()) == folder;
  if (!has_folder) return std::string(name);
  return std::string(name.substr(0, slash + 1)).append(name.substr(slash + 1 + folder.size()));
}

template <class T>
std::vector<std::string> sorted_names(const std::deque<T>& types) {
  std::vector<std::string> names;
  names.reserve(types.size());
  for (const T& type : types) names.push_back(type.name);
  std::sort(names.begin(), names.end());
  return names;
}

class Registry {
 public:
  explicit Registry(RosVersion version) : version_(version) {
    if (version == RosVersion::kRos2 && ros2_is_before_iron()) add_messages(tables::packages_before_iron());
    const std::vector<tables::PackageTable> packages = tables::all_packages(version);
    add_messages(packages);
    for (const auto& package : packages) {
      for (const auto& row : package.services) {
        const MessageType* request = add(*row.request, others_);
        const MessageType* response = add(*row.response, others_);
        keep({row.name, row.type_hash, request, response}, services_);
      }
    }
    for (const auto& [field, name] : unresolved_) field->message = find(name);
    unresolved_.clear();
  }

  const MessageType* find_message(std::string_view name) const { return at(message_by_name_, name, "msg/"); }
  const ServiceType* find_service(std::string_view name) const { return at(service_by_name_, name, "srv/"); }
  std::vector<std::string> message_names() const { return sorted_names(messages_); }
  std::vector<std::string> service_names() const { return sorted_names(services_); }

  const MessageType& add_message(MessageType type) {
    const std::unique_lock lock(mutex_);
    return add(std::move(type));
  }

  const ServiceType& add_service(std::string name, std::string type_hash, MessageType request, MessageType response) {
    const std::unique_lock lock(mutex_);
    if (const ServiceType* known = same(service_by_name_, name, type_hash)) return *known;
    ServiceType service{std::move(name), std::move(type_hash), nullptr, nullptr};
    service.request = &add(std::move(request));
    service.response = &add(std::move(response));
    return *keep(std::move(service), other_services_);
  }

 private:
  template <class T>
  using ByName = std::unordered_map<std::string_view, const T*>;

  /// Those of a known name are left out.
  void add_messages(const std::vector<tables::PackageTable>& packages) {
    for (const auto& package : packages) {
      for (const auto* row : package.messages) {
        if (message_by_name_.count(row->name) == 0) add(*row, messages_);
      }
    }
  }

  const MessageType* add(const tables::MessageRow& row, std::deque<MessageType>& types) {
    MessageType& type = *keep({row.name, row.type_hash, row.definition, row.has_header, {}, {}, version_}, types);
    type.fields.reserve(row.fields.count);  // unresolved_ points into it
    for (const auto& field : row.fields) {
      type.fields.push_back({field.name, field.kind, field.array, field.fixed_length, field.bound, field.string_bound,
                             nullptr, field_key(field.name), std::string(field.default_value)});
      if (field.message != nullptr) unresolved_.emplace_back(&type.fields.back(), field.message);
    }
    for (const auto& constant : row.constants) type.constants.push_back(make_constant(constant));
    return &type;
  }

  const MessageType& add(MessageType type) {
    if (const MessageType* known = same(message_by_name_, type.name, type.type_hash)) return *known;
    for (Field& field : type.fields) field.key = field_key(field.name);
    return *keep(std::move(type), others_);
  }

  MessageType* keep(MessageType type, std::deque<MessageType>& types) {
    MessageType* kept = &types.emplace_back(std::move(type));
    message_by_name_.emplace(kept->name, kept);
    return kept;
  }

  ServiceType* keep(ServiceType type, std::deque<ServiceType>& types) {
    ServiceType* kept = &types.emplace_back(std::move(type));
    service_by_name_.emplace(kept->name, kept);
    return kept;
  }

  /// The known type of that name, or nullptr.
  template <class T>
  static const T* same(const ByName<T>& types, const std::string& name, const std::string& type_hash) {
    const auto found = types.find(name);
    if (found == types.end()) return nullptr;
    if (found->second->type_hash == type_hash) return found->second;
    throw std::invalid_argument(name + " is known with type hash " + found->second->type_hash +
                                ": cannot add it with type hash " + type_hash);
  }

  const MessageType* find(std::string_view name) const {
    const auto found = message_by_name_.find(name);
    if (found == message_by_name_.end()) {
      throw std::logic_error("generated message tables: " + std::string(name) + " is missing");
    }
    return found->second;
  }

  template <class T>
  const T* at(const ByName<T>& types, std::string_view name, std::string_view folder) const {
    const std::shared_lock lock(mutex_);
    auto found = types.find(name);
    if (found == types.end()) found = types.find(without_folder(name, folder));
    return found == types.end() ? nullptr : found->second;
  }

  const RosVersion version_;
  mutable std::shared_mutex mutex_;  // guards all members except messages_ and services_, which stay constant
  // Deques keep references to their elements valid.
  std::deque<MessageType> messages_;        // listed
  std::deque<MessageType> others_;          // requests, responses, added types
  std::deque<ServiceType> services_;        // listed
  std::deque<ServiceType> other_services_;  // added
  ByName<MessageType> message_by_name_;
  ByName<ServiceType> service_by_name_;
  std::vector<std::pair<Field*, const char*>> unresolved_;
};

Registry& registry(RosVersion version) {
  // Never destroyed: threads of the bridge may still use a type while the process ends.
  static Registry& ros1 = *std::make_unique<Registry>(RosVersion::kRos1).release();
  if (version == RosVersion::kRos1) return ros1;
  static Registry& ros2 = *std::make_unique<Registry>(RosVersion::kRos2).release();
  return ros2;
}

}  // namespace

const MessageType* find_message(std::string_view name, RosVersion version) {
  return registry(version).find_message(name);
}

const ServiceType* find_service(std::string_view name, RosVersion version) {
  return registry(version).find_service(name);
}

const MessageType& add_message(MessageType type) {
  Registry& types = registry(type.version);
  return types.add_message(std::move(type));
}

const ServiceType& add_service(std::string name, std::string type_hash, MessageType request, MessageType response) {
  Registry& types = registry(request.version);
  return types.add_service(std::move(name), std::move(type_hash), std::move(request), std::move(response));
}

std::vector<std::string> message_names(RosVersion version) { return registry(version).message_names(); }

std::vector<std::string> service_names(RosVersion version) { return registry(version).service_names(); }

bool ros2_is_before_iron() {
  const char* const variable = std::getenv("ROS_DISTRO");
  const std::string_view distribution = variable != nullptr ? variable : "";
  return distribution == "humble" || distribution == "galactic" || distribution == "foxy";
}

std::uint32_t field_key(std::string_view name) {
  static std::mutex mutex;
  static auto& keys = *std::make_unique<std::map<std::string, std::uint32_t, std::less<>>>().release();
  const std::lock_guard lock(mutex);
  const auto found = keys.find(name);
  if (found != keys.end()) return found->second;
  return keys.emplace(name, static_cast<std::uint32_t>(keys.size())).first->second;
}

}  // namespace bubblesim::messages
