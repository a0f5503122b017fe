// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace bubblesim {

/// The table of elements, in three parts; element_kinds.cpp reads it. One element a line, its children indented below
/// it:
///
///   NAME TYPE [DEFAULT] [MIN..MAX] [required] [~ REASON | ! REASON]
///
/// The default is in quotes when it has spaces; a number without one has no effect unless it is given. `~`: without
/// effect here. `!`: left out, with a warning. `@NAME TYPE [DEFAULT]` is an attribute of the element above. `&NAME`
/// stands for the children of the element that is defined under that name by a line `=NAME` at the start. Names, types,
/// defaults and ranges are those of the specification of SDFormat (sdformat.org/spec). `&sensor_kinds` stands for the
/// lines of all kinds of sensors (SensorDefinition::elements), sorted.
extern const char* const kShapeTable;  ///< geometries, materials, surfaces and lights
extern const char* const kModelTable;  ///< models and their parts
extern const char* const kWorldTable;  ///< worlds and files

}  // namespace bubblesim
