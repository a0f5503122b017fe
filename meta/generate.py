# SPDX-License-Identifier: BSD-3-Clause
"""Generate C++ tables from the lists of message and service types. CMake runs this at configure time.

Writes one C++ file for each message package, one that lists the packages, and tables.cmake, which lists these files and
all inputs. Files that do not change are not written. All errors of the lists are printed at once; the exit code is then
1 and nothing is written. A duplicate type causes a warning.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent / "python" / "bubblesim"

# Code shared with the run time is in the Python package, which cannot be imported before the compiled module exists.
# Import only its folder messages/, below an empty stand-in for the package.
placeholder = ModuleType("bubblesim")
placeholder.__path__ = [str(PACKAGE)]
sys.modules["bubblesim"] = placeholder

try:
    import em  # type: ignore[import-untyped]

    import rules
    from bubblesim.messages.kinds import has_header
    from bubblesim.messages.lists import Entry, read_interfaces, read_list
    from bubblesim.messages.names import split_name
    from bubblesim.messages.packages import build_index
    from bubblesim.messages.ros2_definitions import Ros2Message
    from bubblesim.messages.ros2_specs import Ros2Specs, definitions_before_iron, own_definitions, without_ros1_only
    from bubblesim.messages.specs import Specs, load_list
except ImportError as error:
    sys.exit(f"{error}; install ros-base-dev and use Debian's Python: cmake -DPython3_EXECUTABLE=/usr/bin/python3")


@dataclass(frozen=True)
class TypeTable:
    """Template data of a message, or of the request or response of a service; strings are C++ literals."""

    label: str
    name: str
    type_hash: str
    definition: str
    has_header: str
    fields: list[rules.FieldRow]
    constants: list[rules.ConstantRow]


@dataclass(frozen=True)
class ServiceTable:
    """Template data of a service."""

    name: str
    type_hash: str
    request: TypeTable
    response: TypeTable


def type_table(specs: Specs, spec: Any, kind: str = "msg") -> TypeTable:
    """Return the tables of a genmsg.MsgSpec; kind is "msg" or "srv" and makes the C++ names unique."""
    return TypeTable(
        label=f"{kind}_{split_name(spec.full_name)[1]}",
        name=rules.cpp_string(spec.full_name),
        type_hash=specs.md5(spec),
        definition=rules.cpp_string(specs.full_text(spec)),
        has_header="true" if has_header(spec.types) else "false",
        fields=[rules.field_row(f.name, f.base_type, f.is_array, f.array_len) for f in spec.parsed_fields()],
        constants=[rules.constant_row(c.name, c.type, c.val) for c in spec.constants],
    )


def service_table(specs: Specs, name: str, spec: Any) -> ServiceTable:
    """Return the tables of a genmsg.SrvSpec."""
    return ServiceTable(
        name=rules.cpp_string(name),
        type_hash=specs.md5(spec),
        request=type_table(specs, spec.request, "srv"),
        response=type_table(specs, spec.response, "srv"),
    )


def ros2_type_table(specs: Ros2Specs, message: Ros2Message) -> TypeTable:
    """Return the tables of a type of ROS 2."""
    return TypeTable(
        label=f"{message.folder}_{split_name(message.name)[1]}",
        name=rules.cpp_string(message.name),
        type_hash=specs.message_hash(message),
        definition=rules.cpp_string(specs.full_text(message)),
        has_header="false",
        fields=[rules.ros2_field_row(name, kind, message.defaults.get(name, b"")) for name, kind in message.fields],
        constants=[rules.ros2_constant_row(*constant) for constant in message.constants],
    )


def ros2_service_table(specs: Ros2Specs, name: str, parts: tuple[Ros2Message, Ros2Message]) -> ServiceTable:
    """Return the tables of a service of ROS 2."""
    request, response = (ros2_type_table(specs, part) for part in parts)
    return ServiceTable(rules.cpp_string(name), specs.service_hash(name), request, response)


def expand(template: str, context: dict[str, Any]) -> str:
    """Expand a template from templates/."""
    return str(em.expand((HERE / "templates" / template).read_text(encoding="utf-8"), context))


def write_if_changed(path: Path, text: str) -> None:
    """Write a file only if its text changes, so that it is not compiled again."""
    data = text.encode("utf-8", errors="surrogateescape")
    if not path.is_file() or path.read_bytes() != data:
        path.write_bytes(data)


Tables = dict[str, tuple[list[TypeTable], list[ServiceTable]]]
"""Messages and services by package."""


def all_tables(specs: Any, of_message: Callable[..., TypeTable], of_service: Callable[..., ServiceTable]) -> Tables:
    """Return the tables of all loaded types; specs: Specs or Ros2Specs."""
    tables: Tables = {}
    for name in sorted(specs.messages):
        messages, _ = tables.setdefault(split_name(name)[0], ([], []))
        messages.append(of_message(specs, specs.messages[name]))
    for name in sorted(specs.services):
        _, services = tables.setdefault(split_name(name)[0], ([], []))
        services.append(of_service(specs, name, specs.services[name]))
    return tables


def write_tables(ros1: Tables, ros2: Tables, older: Tables, inputs: list[Path], output: Path) -> None:
    """Write all files and remove the files of packages that are no longer needed."""
    output.mkdir(parents=True, exist_ok=True)
    contents: dict[Path, str] = {}
    for prefix, tables in (("package", ros1), ("ros2_package", ros2), ("older_package", older)):
        for package, (messages, services) in tables.items():
            types = messages + [half for service in services for half in (service.request, service.response)]
            context = {"package": package, "types": types, "messages": messages, "services": services}
            contents[output / f"{prefix}_{package}.cpp"] = expand("package.cpp.em", context | {"prefix": prefix})
    contents[output / "all_packages.cpp"] = expand(
        "all_packages.cpp.em",
        {"packages": sorted(ros1), "ros2_packages": sorted(ros2), "older_packages": sorted(older)},
    )
    for path, text in contents.items():
        write_if_changed(path, text)
    for path in output.glob("*package_*.cpp"):
        if path not in contents:
            path.unlink()
    manifest = expand("tables.cmake.em", {"sources": sorted(contents), "inputs": sorted(inputs)})
    write_if_changed(output / "tables.cmake", manifest)


def parse_arguments(arguments: list[str]) -> argparse.Namespace:
    """Parse the command line; options with paths take lists in the format of the corresponding variables."""

    def paths(separator: str) -> Any:
        return lambda text: [Path(part) for part in text.split(separator) if part]

    parser = argparse.ArgumentParser(prog="generate.py", description=__doc__.partition("\n")[0])
    parser.add_argument("--messages", type=Path, default=HERE / "messages.txt", help="list of message types")
    parser.add_argument("--services", type=Path, default=HERE / "services.txt", help="list of service types")
    parser.add_argument(
        "--interfaces", type=Path, default=HERE / "interfaces.txt", help="list of both, such as std_msgs/msg/String"
    )
    parser.add_argument("--ros2", action="store_true", help="also write the tables of ROS 2's types")
    parser.add_argument("--output", type=Path, required=True, help="folder for the generated files")
    parser.add_argument("--project", type=Path, default=HERE.parent, help="root of this project in the build")
    parser.add_argument("--build", type=Path, help="build folder, used to find the workspace (default: --output)")
    parser.add_argument("--prefix-path", type=paths(";"), default=[], help="CMAKE_PREFIX_PATH of CMake, a;b")
    ros_path = os.environ.get("ROS_PACKAGE_PATH", "")
    parser.add_argument("--ros-package-path", type=paths(":"), default=ros_path, help="default: $ROS_PACKAGE_PATH")
    return parser.parse_args(arguments)


def shown_path(path: Path) -> str:
    """Return a path for messages: relative to the current folder if it is inside."""
    path = path.resolve()
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path)


def main(arguments: list[str]) -> int:
    """Run the generator; return the exit code."""
    options = parse_arguments(arguments)
    index = build_index(
        options.project.absolute(),
        (options.build or options.output).absolute(),
        options.prefix_path,
        options.ros_package_path,
    )
    problems: list[str] = []
    warnings: list[str] = []
    specs = Specs(index)
    messages = read_list(options.messages, shown_path(options.messages), problems, warnings)
    services = read_list(options.services, shown_path(options.services), problems, warnings)
    more = read_interfaces(options.interfaces, shown_path(options.interfaces), problems, warnings)
    messages, services = united(messages, more[0]), united(services, more[1])
    load_list(specs.load, messages, "msg", problems)
    load_list(specs.load, services, "srv", problems)
    ros2 = Ros2Specs(index, own_definitions(before_iron=False))
    older = Ros2Specs(index, own_definitions(before_iron=True))
    if options.ros2 and not problems:
        load_ros2(ros2, messages, services, problems)
        for name in definitions_before_iron().names("msg"):
            older.load(name, "msg")
    for text in (*problems, *(f"warning: {warning}" for warning in warnings)):
        print(text, file=sys.stderr)
    if problems:
        return 1
    own = [options.messages, options.services, *([options.interfaces] if options.interfaces.is_file() else [])]
    own += [*HERE.glob("*.py"), *HERE.glob("templates/*.em")]
    own += [Path(str(module.__file__)) for name, module in sys.modules.items() if name.startswith("bubblesim.")]
    inputs = {path.absolute() for path in [*own, *specs.files, *ros2.files, *older.files, *index.watched]}
    ros1_tables = all_tables(specs, type_table, service_table)
    ros2_tables = all_tables(ros2, ros2_type_table, ros2_service_table)
    older_tables = all_tables(older, ros2_type_table, ros2_service_table)
    write_tables(ros1_tables, ros2_tables, older_tables, sorted(inputs), options.output)
    return 0


def united(entries: list[Entry], more: list[Entry]) -> list[Entry]:
    """Return the entries of both lists, without repetitions."""
    names = {entry.name for entry in entries}
    return [*entries, *(entry for entry in more if entry.name not in names)]


def load_ros2(specs: Ros2Specs, messages: list[Entry], services: list[Entry], problems: list[str]) -> None:
    """Load ROS 2's types of these names, and those that ROS 1 does not have; add errors to `problems`."""
    specs.load_own()
    in_ros2 = set(without_ros1_only(entry.name for entry in messages))
    load_list(specs.load, [entry for entry in messages if entry.name in in_ros2], "msg", problems)
    load_list(specs.load, services, "srv", problems)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
