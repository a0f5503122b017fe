// SPDX-License-Identifier: BSD-3-Clause
#include "load/xml_fault.hpp"

#include <libxml/parser.h>
#include <libxml/xmlerror.h>

#include <limits>
#include <memory>

namespace bubblesim {
namespace {

struct Free {
  void operator()(xmlParserCtxt* context) const { xmlFreeParserCtxt(context); }
  void operator()(xmlDoc* document) const { xmlFreeDoc(document); }
};

std::string text_of(const char* text) { return text != nullptr ? text : ""; }

XmlFault describe(const xmlError& error) {
  if (error.code == XML_ERR_TAG_NAME_MISMATCH) {
    return {error.int1, "<" + text_of(error.str1) + "> is opened here and closed by </" + text_of(error.str2) +
                            "> in line " + std::to_string(error.line)};
  }
  if (error.code == XML_ERR_TAG_NOT_FINISHED) {
    return {error.int1, "<" + text_of(error.str1) + "> is opened here and has no end tag"};
  }
  std::string message = text_of(error.message);
  message.erase(message.find_last_not_of(" \n") + 1);
  return {error.line, message};
}

/// Called for each error of a text; keeps the first, because the others follow from it.
void keep_first(void* found, xmlErrorPtr error) {
  auto& fault = *static_cast<std::optional<XmlFault>*>(found);
  if (!fault && error->level >= XML_ERR_ERROR) fault = describe(*error);
}

}  // namespace

std::optional<XmlFault> find_xml_fault(const std::string& text) {
  std::optional<XmlFault> fault;
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return fault;
  const std::unique_ptr<xmlParserCtxt, Free> context(xmlNewParserCtxt());
  if (context == nullptr) return fault;
  xmlSetStructuredErrorFunc(&fault, keep_first);  // for this thread
  const std::unique_ptr<xmlDoc, Free> document(
      xmlCtxtReadMemory(context.get(), text.data(), static_cast<int>(text.size()), nullptr, nullptr, XML_PARSE_NONET));
  xmlSetStructuredErrorFunc(nullptr, nullptr);
  return fault;
}

}  // namespace bubblesim
