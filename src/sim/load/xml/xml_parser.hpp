// SPDX-License-Identifier: BSD-3-Clause
// Parses XML into elements with their lines.
#pragma once

#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// Returns the root element of a string in UTF-8 or Latin-1; `file` is its name in errors. What Gazebo's parser takes
/// is taken: attributes without quotes are quoted, with a warning each; comments before the declaration, a bare & and
/// further root elements are read. Throws SceneError when the text has no element, is not well-formed, is nested more
/// than 256 deep, has more than a million elements, names of more than 1,000 characters or strings of more than a
/// million.
XmlElement parse_xml(const std::string& text, const std::string& file, std::vector<Problem>& warnings);

/// Writes an element with all below, in lines with an indentation of two spaces.
std::string to_xml(const XmlElement& root);

}  // namespace bubblesim
