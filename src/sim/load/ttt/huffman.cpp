// SPDX-License-Identifier: BSD-3-Clause
#include "load/ttt/huffman.hpp"

#include <cstdint>
#include <vector>

#include "load/ttt/bytes.hpp"

namespace bubblesim::ttt {
namespace {

constexpr std::size_t kMostNodes = 511;

class Bits {
 public:
  Bits(std::string_view bytes, std::size_t offset) : bytes_(bytes), offset_(offset) {}

  unsigned next() {
    if (at_ / 8 >= bytes_.size())
      fail_at(offset_ + bytes_.size(), "the packed content ends early: the file is cut off");
    const auto byte = static_cast<std::uint8_t>(bytes_[at_ / 8]);
    const unsigned bit = byte >> (7 - at_ % 8) & 1U;
    ++at_;
    return bit;
  }

  char next_byte() {
    unsigned value = 0;
    for (int i = 0; i < 8; ++i) value = value << 1U | next();
    return static_cast<char>(value);
  }

  std::size_t offset() const { return offset_ + at_ / 8; }

 private:
  std::string_view bytes_;
  std::size_t offset_;
  std::size_t at_ = 0;
};

struct CodeNode {
  bool is_leaf = false;
  char value = 0;
  std::uint16_t children[2] = {0, 0};  // 0: not read yet; the root is no child
};

std::vector<CodeNode> read_tree(Bits& bits) {
  std::vector<CodeNode> nodes;
  std::vector<std::uint16_t> open;  // inner nodes that lack a child, the deepest last
  do {
    if (nodes.size() == kMostNodes) fail_at(bits.offset(), "the code has more than 511 nodes: the file is damaged");
    const auto index = static_cast<std::uint16_t>(nodes.size());
    CodeNode& node = nodes.emplace_back();
    node.is_leaf = bits.next() == 1;
    if (node.is_leaf) node.value = bits.next_byte();
    if (!open.empty()) {
      CodeNode& parent = nodes[open.back()];
      const bool is_second = parent.children[0] != 0;
      parent.children[is_second ? 1 : 0] = index;
      if (is_second) open.pop_back();
    }
    if (!nodes[index].is_leaf) open.push_back(index);
  } while (!open.empty());
  return nodes;
}

}  // namespace

std::string unpack(std::string_view packed, std::size_t size, std::size_t offset) {
  if (size == 0) return {};
  Bits bits(packed, offset);
  const std::vector<CodeNode> nodes = read_tree(bits);
  if (nodes.front().is_leaf) return std::string(size, nodes.front().value);
  std::string content;
  content.reserve(size);
  while (content.size() < size) {
    const CodeNode* node = &nodes.front();
    while (!node->is_leaf) node = &nodes[node->children[bits.next()]];
    content.push_back(node->value);
  }
  return content;
}

}  // namespace bubblesim::ttt
