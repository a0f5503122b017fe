# SPDX-License-Identifier: BSD-3-Clause
"""Types that are not listed, read from their definitions on this machine, compared with genpy."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import genpy.dynamic
import genpy.message
import pytest
from hypothesis import HealthCheck, given, settings

from bubblesim.messages.packages import machine_index
from message_support import codec, genpy_bytes, genpy_class, messages, same

quick = settings(
    max_examples=20, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck)
)

INDEX = machine_index()
UNLISTED = sorted({*INDEX.names("msg")} - {*codec.message_names()})
SERVICES = [
    name
    for name in sorted({*INDEX.names("srv")} - {*codec.service_names()})
    if genpy.message.get_service_class(name) is not None
]

Package = Callable[[str, dict[str, str]], Path]


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Package:
    """Make a user package in a folder on ROS_PACKAGE_PATH. Types stay known to the process: use new names."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))

    def make(name: str, files: dict[str, str]) -> Path:
        for file, text in {"package.xml": f"<package><name>{name}</name></package>", **files}.items():
            (tmp_path / name / file).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name / file).write_text(text)
        return tmp_path / name

    return make


def error(name: str) -> str:
    """Return the text of the error for a type."""
    with pytest.raises(codec.MessageError) as caught:
        codec.type_hash(name)
    return str(caught.value)


def test_there_are_enough_types_to_test() -> None:
    assert {name.split("/")[0] for name in UNLISTED} >= {"actionlib", "shape_msgs", "stereo_msgs"}
    assert SERVICES


@pytest.mark.parametrize("name", UNLISTED)
def test_md5_and_definition_are_genpys(name: str) -> None:
    assert codec.type_hash(name) == genpy_class(name)._md5sum
    assert codec.definition(name) == genpy_class(name)._full_text


@pytest.mark.parametrize("name", UNLISTED)
def test_constants_are_genpys(name: str) -> None:
    for constant, value in codec.constants(name).items():
        assert same(value, getattr(genpy_class(name), constant)), constant


@pytest.mark.parametrize("name", UNLISTED)
def test_bytes_are_genpys(name: str) -> None:
    @quick
    @given(messages(name))
    def check(message: dict[str, Any]) -> None:
        data = genpy_bytes(name, message)
        assert codec.encode(name, message) == data
        assert same(codec.decode(name, data), message)

    check()


@pytest.mark.parametrize("name", SERVICES)
def test_services_are_genpys(name: str) -> None:
    cls = genpy.message.get_service_class(name)
    request, response = codec.service_halves(name)
    assert codec.service_type_hash(name) == cls._md5sum
    assert codec.definition(request) == cls._request_class._full_text
    assert codec.definition(response) == cls._response_class._full_text


def test_a_users_package_works_at_once(package: Package) -> None:
    package(
        "unlisted_robot",
        {
            "msg/Battery.msg": "Header header\nCell[] cells\nfloat32[3] limits\nuint64 MOST=18446744073709551615\n",
            "msg/Cell.msg": "string NAME=a # b\nchar KIND=7\ngeometry_msgs/Point place\nbyte b\nduration age\n",
        },
    )
    name = "unlisted_robot/Battery"
    generated = genpy.dynamic.generate_dynamic(name, codec.definition(name))
    assert codec.type_hash(name) == generated[name]._md5sum
    assert codec.constants(name) == {"MOST": 2**64 - 1}
    assert codec.constants("unlisted_robot/Cell") == {"NAME": "a # b", "KIND": 7}

    @quick
    @given(messages(name))
    def check(message: dict[str, Any]) -> None:
        assert codec.encode(name, message) == genpy_bytes(name, message)
        assert same(codec.decode(name, codec.encode(name, message)), message)

    check()


def test_a_half_brings_its_service_along(package: Package) -> None:
    package("unlisted_half", {"srv/Charge.srv": "float32 level\n---\nbool done\n"})
    assert codec.fields("unlisted_half/ChargeResponse") == {"done": "bool"}
    assert codec.service_halves("unlisted_half/srv/Charge")[0] == "unlisted_half/ChargeRequest"


def test_one_line_states_where_a_type_is_from_and_how_to_list_it(
    package: Package, capfd: pytest.CaptureFixture[str]
) -> None:
    folder = package("unlisted_reported", {"msg/Outer.msg": "Inner inner\n", "msg/Inner.msg": "int8 a\n"})
    codec.encode("unlisted_reported/msg/Outer", {})
    codec.encode("unlisted_reported/Outer", {"inner": {"a": 1}})
    assert capfd.readouterr().err == (
        f"info: unlisted_reported/Outer is not listed; using its definition from {folder}/msg/Outer.msg. "
        "List it with: rosrun bubblesim add_message unlisted_reported/Outer\n"
    )


def test_an_installation_needs_no_lists(
    package: Package, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("bubblesim.messages.runtime.project_root", lambda: None)
    folder = package("unlisted_installed", {"msg/Cell.msg": "int8 a\n"})
    codec.encode("unlisted_installed/Cell", {})
    assert capfd.readouterr().err == (
        f"info: unlisted_installed/Cell is not listed; using its definition from {folder}/msg/Cell.msg\n"
    )
    assert error("quantum_teleport_msgs/Beam").endswith(
        "; to add it, install its package, or source the setup.bash of the workspace that has it"
    )


def test_a_type_that_appears_later_is_found(package: Package) -> None:
    assert "no definition was found on this machine" in error("unlisted_late/Cell")
    package("unlisted_late", {"msg/Cell.msg": "int8 a\n"})
    assert codec.encode("unlisted_late/Cell", {"a": 1}) == b"\1"


def test_bad_lines_of_a_definition_are_reported_with_their_place(package: Package) -> None:
    folder = package("unlisted_bad", {"msg/Cell.msg": "int8 a\nint8 b c\n"})
    assert error("unlisted_bad/Cell").startswith(
        f"unlisted_bad/Cell: {folder}/msg/Cell.msg:2: Invalid declaration: int8 b c"
    )


def test_a_missing_nested_type_is_reported_with_its_place(package: Package) -> None:
    folder = package("unlisted_gap", {"msg/Cell.msg": "int8 a\nstd_msgs/Hedder[] b\n"})
    assert error("unlisted_gap/Cell") == (
        f"std_msgs/Hedder, used in unlisted_gap/Cell ({folder}/msg/Cell.msg:2), is not found; "
        "did you mean std_msgs/Header?"
    )


def test_a_definition_that_changed_since_it_was_read_is_refused(package: Package) -> None:
    folder = package("unlisted_change", {"msg/Cell.msg": "int8 a\n", "msg/Two.msg": "Cell cell\n"})
    codec.type_hash("unlisted_change/Cell")
    (folder / "msg" / "Cell.msg").write_text("int16 a\n")
    assert "unlisted_change/Cell is known with type hash" in error("unlisted_change/Two")


def test_threads_that_ask_at_once_get_the_same_type(package: Package) -> None:
    package("unlisted_threads", {"msg/Cell.msg": "int8 a\n"})
    program = (
        "from concurrent.futures import ThreadPoolExecutor\n"
        "from bubblesim import _core\n"
        "with ThreadPoolExecutor(8) as pool:\n"
        "    print(set(pool.map(lambda _: _core.messages.encode('unlisted_threads/Cell', {'a': 1}), range(64))))\n"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout == "{b'\\x01'}\n"
    assert run.stderr.count("info: ") == 1


def test_names_of_listed_types_stay_those_of_the_build(package: Package) -> None:
    package("unlisted_names", {"msg/Cell.msg": "int8 a\n"})
    codec.type_hash("unlisted_names/Cell")
    assert "unlisted_names/Cell" not in codec.message_names()
