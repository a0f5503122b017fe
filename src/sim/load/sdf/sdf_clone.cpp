// SPDX-License-Identifier: BSD-3-Clause
// SDFormat clones the description of an element, with those of all elements that it may contain, for each element that
// it reads: a link takes a megabyte and ten milliseconds. Descriptions are not changed after they are read, so clones
// can share them. The linker replaces the library's function by this one (docs/adr/0017).
#include <sdf/Element.hh>
#include <sdf/Param.hh>

namespace sdf {
inline namespace SDF_VERSION_NAMESPACE {

ElementPtr Element::Clone() const {
  auto clone = std::make_shared<Element>();
  ElementPrivate& copy = *clone->dataPtr;
  copy = *dataPtr;  // descriptions as pointers
  copy.parent.reset();
  for (ParamPtr& attribute : copy.attributes) {
    attribute = attribute->Clone();
    attribute->SetParentElement(clone);
  }
  for (ElementPtr& element : copy.elements) {
    element = element->Clone();
    element->SetParent(clone);
  }
  if (copy.value != nullptr) {
    copy.value = copy.value->Clone();
    copy.value->SetParentElement(clone);
  }
  if (copy.includeElement != nullptr) copy.includeElement = copy.includeElement->Clone();
  return clone;
}

}  // namespace SDF_VERSION_NAMESPACE
}  // namespace sdf
