// SPDX-License-Identifier: BSD-3-Clause
#include "peers/refused_peers.hpp"

#include <ros/console.h>
#include <ros/console_backend.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "console/log_line.hpp"
#include "peers/type_version.hpp"

namespace bubblesim {
namespace {

namespace backend = ros::console::backend;

std::mutex listener_mutex;
RefusedPeers* listener = nullptr;
decltype(backend::function_print) print_as_before = nullptr;

void print_unless_taken(void* logger, ros::console::Level level, const char* text, const char* file,
                        const char* function, int line) {
  if (level == ros::console::levels::Error) {
    const std::lock_guard lock(listener_mutex);
    if (listener != nullptr && listener->take(text)) return;
  }
  print_as_before(logger, level, text, file, function, line);
}

/// What `line` has between these words, one after the other, at its beginning; nothing if it has other words.
std::vector<std::string> parts_between(const std::string& line, const std::vector<std::string>& words) {
  if (line.compare(0, words.front().size(), words.front()) != 0) return {};
  std::vector<std::string> parts;
  std::size_t begin = words.front().size();
  for (auto word = words.begin() + 1; word != words.end(); ++word) {
    const std::size_t end = line.find(*word, begin);
    if (end == std::string::npos) return {};
    parts.push_back(line.substr(begin, end - begin));
    begin = end + word->size();
  }
  return parts;
}

/// Of a string "package/Type/md5".
TypeVersion type_version(const std::string& text) {
  const std::size_t slash = std::min(text.rfind('/'), text.size());
  return {text.substr(0, slash), text.substr(std::min(slash + 1, text.size()))};
}

/// From ros::Publication::validateHeader().
std::optional<std::string> subscriber_refused(const std::string& line) {
  const std::vector<std::string> parts = parts_between(
      line, {"Client [", "] wants topic ", " to have datatype/md5sum [", "], but our version has [", "]."});
  if (parts.empty()) return std::nullopt;
  const TypeVersion theirs = type_version(parts[2]);
  const TypeVersion ours = type_version(parts[3]);
  return "topic '" + parts[1] + "': node " + parts[0] + " subscribes to " + shown(theirs) +
         ", but this node publishes " + shown(ours) + ", so no messages are sent to it; " + cure(theirs, ours);
}

/// From ros::ServiceClientLink::handleHeader(), which logs neither the client's name nor its type.
std::optional<std::string> client_refused(const std::string& line) {
  const std::vector<std::string> parts =
      parts_between(line, {"client wants service ", " to have md5sum ", ", but it has ", ". Dropping"});
  if (parts.empty()) return std::nullopt;
  const auto service = ros::ServiceManager::instance()->lookupServicePublication(parts[0]);
  const TypeVersion ours{service ? service->getDataType() : "another type", parts[2]};
  return "service '" + parts[0] + "': a client calls a type with md5 " + parts[1] + ", but this node provides " +
         shown(ours) + ", so the call is refused; use the same type in both, built from the same definition";
}

}  // namespace

RefusedPeers::RefusedPeers() {
  ros::console::initialize();
  const std::lock_guard lock(listener_mutex);
  listener = this;
  if (print_as_before != nullptr) return;
  print_as_before = backend::function_print;
  backend::function_print = print_unless_taken;
}

RefusedPeers::~RefusedPeers() {
  const std::lock_guard lock(listener_mutex);
  listener = nullptr;
}

bool RefusedPeers::take(const std::string& line) {
  constexpr std::size_t kLongest = 2000;  // peers choose their names, and what was reported is remembered
  if (line.size() > kLongest) return false;
  std::optional<std::string> text = subscriber_refused(line);
  if (!text) text = client_refused(line);
  if (!text) return false;
  constexpr std::size_t kMostReported = 100;
  const std::lock_guard lock(mutex_);
  if (reported_.size() == kMostReported || !reported_.insert(*text).second) return true;
  log_line(*text);
  if (reported_.size() == kMostReported) {
    log_line("nodes that use other types were reported " + std::to_string(kMostReported) +
             " times; further ones are not reported");
  }
  return true;
}

}  // namespace bubblesim
