// SPDX-License-Identifier: BSD-3-Clause
// Reads documents with SDFormat. SDFormat parses its whole specification, some eighty files, for each document, which
// takes ten times longer than reading a robot: here it is parsed once in the process.
#pragma once

#include <filesystem>
#include <sdf/Root.hh>
#include <sdf/parser.hh>
#include <string>

namespace bubblesim {

/// SDFormat's description of the root element, with those of all elements below it.
const sdf::ElementPtr& root_description();

/// Like sdf::Root::Load().
sdf::Errors load_document(sdf::Root& root, const std::filesystem::path& file, const sdf::ParserConfig& config);
/// Like sdf::Root::LoadSdfString().
sdf::Errors load_document_text(sdf::Root& root, const std::string& text, const sdf::ParserConfig& config);

}  // namespace bubblesim
