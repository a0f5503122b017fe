// SPDX-License-Identifier: BSD-3-Clause
// What the parsers of SDFormat and URDF would write to stderr in forms of their own.
#pragma once

#include <console_bridge/console.h>

#include <iostream>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace bubblesim {

/// Hears all that they say as long as it lives. One at a time in the process: another one waits.
class ParserMessages final : public console_bridge::OutputHandler {
 public:
  ParserMessages();
  ~ParserMessages() override;
  ParserMessages(const ParserMessages&) = delete;
  ParserMessages& operator=(const ParserMessages&) = delete;

  /// Each once, in plain text.
  const std::vector<std::string>& of_urdf() const { return of_urdf_; }
  std::vector<std::string> of_sdformat() const;

 private:
  void log(const std::string& text, console_bridge::LogLevel level, const char* file, int line) override;

  std::scoped_lock<std::mutex> lock_;
  std::vector<std::string> of_urdf_;
  std::ostringstream console_;  // in place of std::cerr, which SDFormat writes to
  std::streambuf* stderr_;
};

}  // namespace bubblesim
