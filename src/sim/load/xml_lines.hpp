// SPDX-License-Identifier: BSD-3-Clause
// Places in XML: in a file that is changed before it is read, too, errors point at the file as the user has it.
#pragma once

#include <tinyxml2.h>

#include <string>

namespace bubblesim {

/// A document as text, each element in the line where the file has it.
std::string print_in_lines(const tinyxml2::XMLDocument& document);

/// The text with blanks in place of an XML declaration that stands behind something else, such as a comment: parsers of
/// XML refuse those.
std::string without_late_declaration(std::string text);

/// `/Model/joint` from the names of an element and its ancestors.
std::string object_path(const tinyxml2::XMLElement& element);

}  // namespace bubblesim
