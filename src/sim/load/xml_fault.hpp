// SPDX-License-Identifier: BSD-3-Clause
// Finds the error in a text that is not well-formed XML.
#pragma once

#include <optional>
#include <string>

namespace bubblesim {

struct XmlFault {
  int line = 0;
  std::string message;  ///< such as: <link> is opened here and closed by </model> in line 9
};

/// The first error of a text; empty when it is well-formed. libxml2 names the elements, tinyxml2 does not.
std::optional<XmlFault> find_xml_fault(const std::string& text);

}  // namespace bubblesim
