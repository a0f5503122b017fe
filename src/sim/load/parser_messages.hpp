// SPDX-License-Identifier: BSD-3-Clause
// Captures the messages that the SDFormat and URDF parsers print on stderr.
#pragma once

#include <console_bridge/console.h>

#include <iostream>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace bubblesim {

/// Captures all messages during its lifetime. One instance at a time in the process: another one waits.
class ParserMessages final : public console_bridge::OutputHandler {
 public:
  ParserMessages();
  ~ParserMessages() override;
  ParserMessages(const ParserMessages&) = delete;
  ParserMessages& operator=(const ParserMessages&) = delete;

  /// Each message once, in plain text.
  const std::vector<std::string>& of_urdf() const { return of_urdf_; }
  std::vector<std::string> of_sdformat() const;

 private:
  void log(const std::string& text, console_bridge::LogLevel level, const char* file, int line) override;

  std::scoped_lock<std::mutex> lock_;
  std::vector<std::string> of_urdf_;
  std::ostringstream console_;  // replaces std::cerr, to which SDFormat writes
  std::streambuf* stderr_;
};

}  // namespace bubblesim
