// SPDX-License-Identifier: BSD-3-Clause
// The numbers in the attributes of URDF, and elements of SDFormat made of them. What cannot be read is reported for the
// object at a path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/math.hpp"
#include "load/load_context.hpp"
#include "load/xml/xml_element.hpp"

namespace bubblesim {

/// An attribute with one finite number. Empty when there is none, or when it is not a number, which is reported.
std::optional<double> number_in(const XmlElement& element, const std::string& attribute, const std::string& path,
                                LoadContext& context);

/// The same for an attribute that must not be absent.
std::optional<double> required_number_in(const XmlElement& element, const std::string& attribute,
                                         const std::string& path, LoadContext& context);

/// The same for an attribute with three finite numbers.
std::optional<Vector3> vector_in(const XmlElement& element, const std::string& attribute, const std::string& path,
                                 LoadContext& context);
std::optional<Vector3> required_vector_in(const XmlElement& element, const std::string& attribute,
                                          const std::string& path, LoadContext& context);

/// The <origin> of an element, in the frame that the element is in.
Pose origin_of(const XmlElement& element, const std::string& path, LoadContext& context);

/// An element without content, in the place of another for errors.
XmlElement in_place_of(const XmlElement& other, const std::string& name);

/// The same with a name.
XmlElement named_element(const std::string& kind, const std::string& name, const XmlElement& place);

/// SDFormat's <pose>, in the place of another element.
XmlElement pose_element(const Pose& pose, const XmlElement& place);

}  // namespace bubblesim
