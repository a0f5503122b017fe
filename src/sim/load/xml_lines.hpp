// SPDX-License-Identifier: BSD-3-Clause
// Keeps locations in XML: errors refer to the user's file, also if it was changed before reading.
#pragma once

#include <tinyxml2.h>

#include <string>

namespace bubblesim {

/// A document as text, with each element in its line of the file.
std::string print_in_lines(const tinyxml2::XMLDocument& document);

/// The text with blanks in place of an XML declaration that is not at the start, such as after a comment: XML parsers
/// reject it.
std::string without_late_declaration(std::string text);

/// `/Model/joint` from the names of an element and its ancestors.
std::string object_path(const tinyxml2::XMLElement& element);

}  // namespace bubblesim
