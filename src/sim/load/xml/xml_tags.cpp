// SPDX-License-Identifier: BSD-3-Clause
#include "load/xml/xml_tags.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace bubblesim {
namespace {

bool is_space(char character) { return std::isspace(static_cast<unsigned char>(character)) != 0; }

/// One tag from '<' to '>', or what is no tag: text, comments, CDATA, declarations.
struct Piece {
  std::string_view text;
  bool is_tag = false;
};

/// Divides a document into tags and what is between them.
class Pieces {
 public:
  explicit Pieces(std::string_view text) : rest_(text) {}

  std::optional<Piece> next() {
    if (rest_.empty()) return std::nullopt;
    if (rest_.front() != '<') return cut(rest_.find('<'), false);
    if (starts("<!--")) return cut(after("-->"), false);
    if (starts("<![CDATA[")) return cut(after("]]>"), false);
    if (starts("<?") || starts("<!")) return cut(after(">"), false);
    return cut(end_of_tag(), true);
  }

 private:
  bool starts(std::string_view with) const { return rest_.substr(0, with.size()) == with; }
  std::size_t after(std::string_view end) const {
    const std::size_t found = rest_.find(end);
    return found == std::string_view::npos ? rest_.size() : found + end.size();
  }
  /// A '>' within quotes does not end a tag; a quote counts only after '='.
  std::size_t end_of_tag() const {
    for (std::size_t at = 1; at < rest_.size(); ++at) {
      if (rest_[at] == '>') return at + 1;
      if (rest_[at] == '<') return at;  // a tag without its end
      if (rest_[at] != '=') continue;
      std::size_t value = at + 1;
      while (value < rest_.size() && is_space(rest_[value])) ++value;
      if (value >= rest_.size() || (rest_[value] != '"' && rest_[value] != '\'')) continue;
      const std::size_t close = rest_.find(rest_[value], value + 1);
      if (close == std::string_view::npos) return rest_.size();
      at = close;
    }
    return rest_.size();
  }
  Piece cut(std::size_t length, bool is_tag) {
    const Piece piece{rest_.substr(0, length), is_tag};
    rest_.remove_prefix(piece.text.size());
    return piece;
  }

  std::string_view rest_;
};

int lines_in(std::string_view text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

/// Rewrites one tag. Returns whether it changed.
bool quote(std::string_view tag, std::string& out) {
  const std::size_t start = out.size();
  std::size_t at = 0;
  while (at < tag.size()) {
    out += tag[at];
    if (tag[at++] != '=') continue;
    while (at < tag.size() && is_space(tag[at])) out += tag[at++];
    if (at < tag.size() && (tag[at] == '"' || tag[at] == '\'')) {
      const std::size_t close = std::min(tag.find(tag[at], at + 1), tag.size() - 1);
      out += tag.substr(at, close + 1 - at);
      at = close + 1;
      if (at < tag.size() && !is_space(tag[at]) && tag[at] != '>' && tag[at] != '/') out += ' ';
      continue;
    }
    std::size_t end = at;
    while (end < tag.size() && !is_space(tag[end]) && tag[end] != '>') ++end;
    if (end > at && end < tag.size() && tag[end] == '>' && tag[end - 1] == '/') --end;
    std::string value(tag.substr(at, end - at));
    value.erase(std::remove(value.begin(), value.end(), '"'), value.end());
    out += '"' + value + '"';
    at = end;
  }
  return out.size() - start != tag.size();
}

std::string_view name_of(std::string_view tag) {
  tag.remove_prefix(std::min<std::size_t>(tag.size() > 1 && tag[1] == '/' ? 2 : 1, tag.size()));
  const std::size_t end = tag.find_first_of(" \t\r\n/>");
  return tag.substr(0, end);
}

}  // namespace

QuotedText with_quoted_attributes(const std::string& text) {
  QuotedText quoted;
  quoted.text.reserve(text.size() + text.size() / 8);
  int line = 1;
  Pieces pieces(text);
  while (const auto piece = pieces.next()) {
    if (!piece->is_tag) {
      quoted.text += piece->text;
    } else if (quote(piece->text, quoted.text)) {
      quoted.lines.push_back(line);
    }
    line += lines_in(piece->text);
  }
  return quoted;
}

std::optional<XmlFault> find_unclosed_tag(const std::string& text) {
  std::vector<std::pair<std::string_view, int>> open;
  int line = 1;
  Pieces pieces(text);
  while (const auto piece = pieces.next()) {
    const std::string_view tag = piece->text;
    const int here = line;
    line += lines_in(tag);
    if (!piece->is_tag) continue;
    const std::string name(name_of(tag));
    if (tag.back() != '>') return XmlFault{here, "the tag <" + name + " has no end '>'"};
    if (tag[tag.size() - 2] == '/') continue;
    if (tag[1] != '/') {
      open.emplace_back(name_of(tag), here);
      continue;
    }
    if (open.empty()) return XmlFault{here, "</" + name + "> closes nothing"};
    const auto [opened, where] = open.back();
    open.pop_back();
    if (opened != name) {
      return XmlFault{where, "<" + std::string(opened) + "> is opened here and closed by </" + name + "> in line " +
                                 std::to_string(here)};
    }
  }
  if (open.empty()) return std::nullopt;
  return XmlFault{open.back().second, "<" + std::string(open.back().first) + "> is opened here and has no end tag"};
}

}  // namespace bubblesim
