// SPDX-License-Identifier: BSD-3-Clause
#include "load/parser_messages.hpp"

#include <algorithm>
#include <regex>

namespace bubblesim {
namespace {

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

void add_once(std::vector<std::string>& messages, const std::string& message) {
  if (std::find(messages.begin(), messages.end(), message) == messages.end()) messages.push_back(message);
}

}  // namespace

ParserMessages::ParserMessages() : lock_(one_at_a_time()), stderr_(std::cerr.rdbuf(console_.rdbuf())) {
  console_bridge::useOutputHandler(this);
}

ParserMessages::~ParserMessages() {
  console_bridge::restorePreviousOutputHandler();
  std::cerr.rdbuf(stderr_);
}

void ParserMessages::log(const std::string& text, console_bridge::LogLevel level, const char*, int) {
  if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN) add_once(of_urdf_, text);
}

/// Without colour codes, source location in SDFormat and severity.
std::vector<std::string> ParserMessages::of_sdformat() const {
  static const std::regex colour(R"(\x1b\[[0-9;]*m)");
  static const std::regex speaker(R"(^(Warning|Error|Message) \[[^\]]*\]:? *(urdf2sdf: *)?)");
  std::vector<std::string> messages;
  std::istringstream lines(console_.str());
  for (std::string line; std::getline(lines, line);) {
    line = std::regex_replace(std::regex_replace(line, colour, ""), speaker, "");
    if (!line.empty()) add_once(messages, line);
  }
  return messages;
}

}  // namespace bubblesim
