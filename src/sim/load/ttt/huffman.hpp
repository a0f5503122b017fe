// SPDX-License-Identifier: BSD-3-Clause
// Huffman coding as in CoppeliaSim's files: one stream of bits, the most significant of each byte first. It begins with
// the tree in preorder (1 and the 8 bits of a value: a leaf; 0: an inner node, then its two children), the codes
// follow.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bubblesim::ttt {

/// Unpacks exactly `size` bytes; the caller limits the size. `offset`: of the first byte in the file, for errors.
/// Throws FormatError when the tree has more than 511 nodes or the bits end early.
std::string unpack(std::string_view packed, std::size_t size, std::size_t offset);

}  // namespace bubblesim::ttt
