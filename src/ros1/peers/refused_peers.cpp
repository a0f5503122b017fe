// SPDX-License-Identifier: BSD-3-Clause
#include "peers/refused_peers.hpp"

#include <ros/console.h>
#include <ros/console_backend.h>
#include <ros/service_manager.h>
#include <ros/service_publication.h>

#include <optional>
#include <regex>
#include <string>

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

/// From ros::Publication::validateHeader().
std::optional<std::string> subscriber_refused(const std::string& line) {
  static const std::regex kPattern(
      R"(Client \[(.*)\] wants topic (.*) to have datatype/md5sum \[(.*)/(.*)\], but our version has \[(.*)/(.*)\]\..*)");
  std::smatch part;
  if (!std::regex_match(line, part, kPattern)) return std::nullopt;
  const TypeVersion theirs{part[3], part[4]};
  const TypeVersion ours{part[5], part[6]};
  return "topic '" + part[2].str() + "': node " + part[1].str() + " subscribes to " + shown(theirs) +
         ", but this node publishes " + shown(ours) + ", so no messages are sent to it; " + cure(theirs, ours);
}

/// From ros::ServiceClientLink::handleHeader(), which logs neither the client's name nor its type.
std::optional<std::string> client_refused(const std::string& line) {
  static const std::regex kPattern(R"(client wants service (.*) to have md5sum (.*), but it has (.*)\. Dropping.*)");
  std::smatch part;
  if (!std::regex_match(line, part, kPattern)) return std::nullopt;
  const auto service = ros::ServiceManager::instance()->lookupServicePublication(part[1]);
  const TypeVersion ours{service ? service->getDataType() : "another type", part[3]};
  return "service '" + part[1].str() + "': a client calls a type with md5 " + part[2].str() +
         ", but this node provides " + shown(ours) +
         ", so the call is refused; use the same type in both, built from the same definition";
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
  constexpr std::size_t kLongest = 2000;  // std::regex uses stack per character, and peers choose their names
  if (line.size() > kLongest) return false;
  std::optional<std::string> text = subscriber_refused(line);
  if (!text) text = client_refused(line);
  if (!text) return false;
  constexpr std::size_t kMostReported = 100;  // peers choose their names
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
