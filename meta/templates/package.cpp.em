@# Context:
@#   package   name of the message package, such as "geometry_msgs"
@#   prefix    of the name of the function: "package", "ros2_package" for types of ROS 2, "older_package" before Iron
@#   types     list of generate.TypeTable: its messages, then the requests and responses of its services
@#   messages  the messages in `types`
@#   services  list of generate.ServiceTable
// generated from the definitions of @package listed in meta/messages.txt and meta/services.txt, do not edit
#include "message_tables.hpp"

namespace bubblesim::messages::tables {
namespace @(prefix)_@(package)_rows {
namespace {
@[for type in types]@

@[if type.fields]@
constexpr FieldRow kFields_@(type.label)[] = {
@[for row in type.fields]@
    {@row.name, FieldKind::@row.kind, ArrayKind::@row.array, @row.length, @row.bound, @row.string_bound, @row.message, @row.default},
@[end for]@
};
@[end if]@
@[if type.constants]@
constexpr ConstantRow kConstants_@(type.label)[] = {
@[for row in type.constants]@
    {@row.name, FieldKind::@row.kind, @row.value},
@[end for]@
};
@[end if]@
constexpr MessageRow k_@(type.label) = {
    @type.name, "@type.type_hash", @type.has_header,
    @(f"kFields_{type.label}" if type.fields else "{}"), @(f"kConstants_{type.label}" if type.constants else "{}"),
    @type.definition};
@[end for]@

@[if messages]@
constexpr const MessageRow* kMessages[] = {
@[for type in messages]@
    &k_@(type.label),
@[end for]@
};
@[end if]@
@[if services]@
constexpr ServiceRow kServices[] = {
@[for service in services]@
    {@service.name, "@service.type_hash", &k_@(service.request.label), &k_@(service.response.label)},
@[end for]@
};
@[end if]@

constexpr PackageTable kTable = {@("kMessages" if messages else "{}"), @("kServices" if services else "{}")};

}  // namespace
}  // namespace @(prefix)_@(package)_rows

PackageTable @(prefix)_@(package)() { return @(prefix)_@(package)_rows::kTable; }

}  // namespace bubblesim::messages::tables
