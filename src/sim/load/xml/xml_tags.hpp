// SPDX-License-Identifier: BSD-3-Clause
// Finds the tags in a document that is not well-formed XML: to repair its attributes, and to report what is wrong.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bubblesim {

struct QuotedText {
  std::string text;
  std::vector<int> lines;  ///< of the attributes that were changed
};

/// Puts quotes around the values of attributes that have none, like TinyXML: up to the next space or the tag's end,
/// also empty ones; and a space between an attribute and the next.
QuotedText with_quoted_attributes(const std::string& text);

struct XmlFault {
  int line = 0;
  std::string message;  ///< such as: <link> is opened here and closed by </model> in line 9
};

/// The first tag that is not closed, or is closed by another one.
std::optional<XmlFault> find_unclosed_tag(const std::string& text);

}  // namespace bubblesim
