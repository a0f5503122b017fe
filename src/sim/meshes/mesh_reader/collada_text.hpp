// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace bubblesim {

/// The text of a COLLADA file without what Assimp's parser stumbles over: comments, and white space before the first
/// word of an element's text, where it expects a number.
std::string plain_collada(const std::string& text);

}  // namespace bubblesim
