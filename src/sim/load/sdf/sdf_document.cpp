// SPDX-License-Identifier: BSD-3-Clause
#include "load/sdf/sdf_document.hpp"

#include <memory>
#include <utility>

namespace bubblesim {
namespace {

sdf::SDFPtr empty_document() {
  auto document = std::make_shared<sdf::SDF>();
  document->Root(root_description()->Clone());  // shares the descriptions, see sdf_clone.cpp
  return document;
}

sdf::Errors load(sdf::Root& root, bool is_read, const sdf::SDFPtr& document, sdf::Error failure, sdf::Errors errors,
                 const sdf::ParserConfig& config) {
  if (!is_read) {
    errors.push_back(std::move(failure));
    return errors;
  }
  const sdf::Errors of_content = root.Load(document, config);
  errors.insert(errors.end(), of_content.begin(), of_content.end());
  return errors;
}

}  // namespace

const sdf::ElementPtr& root_description() {
  static const sdf::ElementPtr root = [] {
    const auto format = std::make_shared<sdf::SDF>();
    sdf::init(format);
    return format->Root();
  }();
  return root;
}

sdf::Errors load_document(sdf::Root& root, const std::filesystem::path& file, const sdf::ParserConfig& config) {
  const sdf::SDFPtr document = empty_document();
  sdf::Errors errors;
  const bool is_read = sdf::readFile(file.string(), config, document, errors);
  return load(root, is_read, document, {sdf::ErrorCode::FILE_READ, "Unable to read file:" + file.string()},
              std::move(errors), config);
}

sdf::Errors load_document_text(sdf::Root& root, const std::string& text, const sdf::ParserConfig& config) {
  const sdf::SDFPtr document = empty_document();
  sdf::Errors errors;
  const bool is_read = sdf::readString(text, config, document, errors);
  return load(root, is_read, document, {sdf::ErrorCode::STRING_READ, "Unable to read SDF string: " + text},
              std::move(errors), config);
}

}  // namespace bubblesim
