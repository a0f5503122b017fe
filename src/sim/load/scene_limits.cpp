// SPDX-License-Identifier: BSD-3-Clause
#include "load/scene_limits.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <sdf/SDFImpl.hh>
#include <sdf/parser.hh>
#include <utility>

#include "load/sdf/frame_work.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr std::uint64_t kMegabyte = 1ULL << 20U;
constexpr std::uint64_t kLargestFile = 100 * kMegabyte;
constexpr std::uint64_t kMostElements = 1'000'000;  // SDFormat takes 2 kB for each
constexpr std::size_t kLongestName = 1000;
constexpr std::size_t kLongestText = 1'000'000;
constexpr std::size_t kDeepestInclude = 20;

[[noreturn]] void fail(const std::string& file, int line, const std::string& message) {
  throw SceneError({{file, line, "", message}});
}

bool is_included_model(const XMLElement& element) {
  return std::strcmp(element.Name(), "include") == 0 && element.FirstChildElement("uri") != nullptr &&
         element.FirstChildElement("uri")->GetText() != nullptr;
}

class Walk {
 public:
  explicit Walk(const sdf::ParserConfig& config) : config_(config) {}

  /// Counts the elements of a document, including those of included files.
  std::uint64_t visit(const tinyxml2::XMLDocument& document, const std::string& file) {
    open_.push_back(file);
    std::uint64_t elements = 0;
    visit(*document.RootElement(), elements);
    open_.pop_back();
    return elements;
  }

  std::vector<std::string> done() && { return std::move(done_); }

 private:
  void visit(const XMLElement& element, std::uint64_t& elements) {
    const std::string& file = open_.back();
    const int line = element.GetLineNum();
    for (const auto* attribute = element.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
      const bool is_name = std::strcmp(attribute->Name(), "name") == 0;
      check_length(is_name ? "the name" : std::string("the attribute ") + attribute->Name(), attribute->Value(),
                   is_name ? kLongestName : kLongestText, attribute->GetLineNum());
    }
    if (element.GetText() != nullptr) {
      check_length(
          "the text of <" + std::string(element.Name(), std::min<std::size_t>(std::strlen(element.Name()), 40)) + ">",
          element.GetText(), kLongestText, line);
    }
    if (const std::string problem = frame_work_problem(element); !problem.empty()) fail(file, line, problem);
    elements += 1;
    if (is_included_model(element)) elements += visit_included(element);
    if (elements > kMostElements) {
      fail(file, line,
           "too many elements: more than " + std::to_string(kMostElements) + ", including those of all included files");
    }
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      visit(*child, elements);
    }
  }

  void check_length(const std::string& what, const char* text, std::size_t most, int line) const {
    const std::size_t length = std::strlen(text);
    if (length <= most) return;
    fail(open_.back(), line,
         what + " '" + std::string(text, 40) + "...' has " + std::to_string(length) + " characters; the maximum is " +
             std::to_string(most));
  }

  std::uint64_t visit_included(const XMLElement& include) {
    const int line = include.GetLineNum();
    const std::string named = sdf::findFile(include.FirstChildElement("uri")->GetText(), true, true, config_);
    const std::string said = fs::is_directory(named) ? model_file(named, line) : named;
    if (said.empty() || !fs::exists(said)) return 0;  // SDFormat reports it
    expect_regular(said, line);
    const std::string file = fs::canonical(said).string();
    if (file == open_.back()) fail(file, line, "the file includes itself");
    if (std::find(open_.begin(), open_.end(), file) != open_.end()) {
      fail(open_.back(), line, "includes " + file + ", which includes this file, directly or through other files");
    }
    if (open_.size() > kDeepestInclude) {
      fail(open_.back(), line, "more than " + std::to_string(kDeepestInclude) + " levels of includes");
    }
    const auto [found, is_new] = elements_of_.try_emplace(file, 0);
    if (!is_new) return found->second;
    check_size(file);
    tinyxml2::XMLDocument document;
    if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS || document.RootElement() == nullptr) return 0;
    const std::uint64_t elements = visit(document, file);
    done_.push_back(file);
    return elements_of_[file] = elements;
  }

  /// The file of a model's folder, or an empty string.
  std::string model_file(const std::string& folder, int line) {
    for (const char* name : {"model.config", "manifest.xml"}) {
      const fs::path config = fs::path(folder) / name;
      if (!fs::exists(config)) continue;
      expect_regular(config, line);
      check_size(config);
      tinyxml2::XMLDocument document;
      if (document.LoadFile(config.c_str()) != tinyxml2::XML_SUCCESS) return {};
      const auto* model = document.FirstChildElement("model");
      // SDFormat reads the name without checking whether it exists.
      const auto* called = model != nullptr ? model->FirstChildElement("name") : nullptr;
      if (model != nullptr && (called == nullptr || called->GetText() == nullptr)) {
        fail(config.string(), model->GetLineNum(), "has no <name>: add <name>the model's name</name>");
      }
      return sdf::getModelFilePath(folder);
    }
    return {};
  }

  void expect_regular(const fs::path& file, int line) const {
    if (!fs::is_regular_file(file)) {
      fail(open_.back(), line, "includes " + file.string() + ", which is not a regular file");
    }
  }

  const sdf::ParserConfig& config_;
  std::vector<std::string> open_;  // the files that include the element
  std::vector<std::string> done_;
  std::map<std::string, std::uint64_t> elements_of_;
};

}  // namespace

void check_size(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size <= kLargestFile) return;
  fail(file.string(), 0,
       "is " + std::to_string(size / kMegabyte) + " MB large; the maximum is " +
           std::to_string(kLargestFile / kMegabyte) + " MB");
}

std::vector<std::string> check_limits(const SceneXml& xml, const sdf::ParserConfig& config) {
  Walk walk(config);
  std::error_code no_file;  // a text is not a file
  const fs::path file = fs::canonical(xml.file(), no_file);
  walk.visit(xml.document(), no_file ? xml.file() : file.string());
  return std::move(walk).done();
}

}  // namespace bubblesim
