// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/error.hpp"

#include <exception>
#include <utility>

namespace bubblesim {
namespace {

std::string joined(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + problem.text();
  return text;
}

}  // namespace

std::string with_article(std::string_view noun) {
  const bool vowel = !noun.empty() && std::string_view("aeiouAEIOU").find(noun.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(noun);
}

std::string text_of_handled_exception() {
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an exception that is not derived from std::exception";
  }
}

std::string Problem::text() const {
  std::string text = file;
  if (line > 0) text += ":" + std::to_string(line);
  if (!text.empty()) text += ": ";
  if (!object.empty()) text += object + ": ";
  return text + message;
}

SceneError::SceneError(std::vector<Problem> found, std::vector<Problem> warned)
    : std::runtime_error(joined(found)), problems(std::move(found)), warnings(std::move(warned)) {}

}  // namespace bubblesim
