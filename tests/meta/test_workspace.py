# SPDX-License-Identifier: BSD-3-Clause
"""The message tools in a user's workspace."""

from hashlib import md5
from pathlib import Path

import pytest

from workspace_support import Workspace


@pytest.fixture(scope="module", params=["catkin", "catkin_make"])
def built(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Workspace:
    """Build a workspace with a package whose type is not listed. Tests share it: a build from nothing takes long."""
    made = Workspace(tmp_path_factory.mktemp("workspace"), request.param)
    made.create("std_msgs/String\ntest_msgs/Notification\n")
    made.add_package("my_robot", {"Cell.msg": "float32 volt\n"})
    made.build()
    return made


def checksum(text: str) -> str:
    """Return the checksum of a type without nested types, comments and constants."""
    return md5(text.strip().encode()).hexdigest()


def test_without_a_test_msgs_of_the_users_the_projects_is_built(built: Workspace) -> None:
    assert built.compiled(checksum("string messages"))


def test_add_message_lists_and_compiles_a_type_of_the_workspace(built: Workspace) -> None:
    assert not built.compiled("my_robot/Cell")
    result = built.add_message("my_robot/Cell", "std_srvs/SetBool")
    assert result.returncode == 0, result.stdout
    assert f"my_robot/Cell: listed at {built.project}/meta/messages.txt:4\n" in result.stdout
    assert f"std_srvs/SetBool: listed at {built.project}/meta/services.txt:1\n" in result.stdout
    assert "my_robot/Cell, std_srvs/SetBool: compiled in " in result.stdout
    assert built.compiled(checksum("float32 volt"))
    assert built.compiled("std_srvs/SetBool")


def test_editing_a_definition_rebuilds_its_tables(built: Workspace) -> None:
    built.write("bubblesim/meta/messages.txt", "std_msgs/String\nmy_robot/Cell\n")
    built.write("my_robot/msg/Cell.msg", "float64 volt\n")
    built.build()
    assert built.compiled(checksum("float64 volt"))
    assert not built.compiled(checksum("float32 volt"))


def test_a_test_msgs_of_the_users_replaces_the_projects(tmp_path: Path) -> None:
    workspace = Workspace(tmp_path, "catkin")
    workspace.create("test_msgs/Notification\n")
    workspace.add_package("test_msgs", {"Notification.msg": "string mine\n"})
    workspace.build()
    assert workspace.compiled(checksum("string mine"))
    header = workspace.folder / "devel" / "include" / "test_msgs" / "Notification.h"
    assert "string mine" in header.read_text()


@pytest.fixture
def unbuilt(tmp_path: Path) -> Workspace:
    made = Workspace(tmp_path, "catkin_make")
    made.create("std_msgs/String\n")
    return made


def test_add_message_can_leave_the_build_to_the_user(unbuilt: Workspace) -> None:
    result = unbuilt.add_message("std_msgs/Bool", "--no-build")
    assert (result.returncode, result.stdout) == (
        0,
        f"std_msgs/Bool: listed at {unbuilt.project}/meta/messages.txt:1\n",
    )
    assert not (unbuilt.folder / "build").exists()


def test_add_message_writes_nothing_when_a_type_is_wrong(unbuilt: Workspace) -> None:
    result = unbuilt.add_message("std_msgs/Bool", "geometry_msgs/Twits", "Twist", "--no-build")
    assert result.returncode == 2
    assert result.stdout.splitlines() == [
        "error: geometry_msgs/Twits is not found on this machine; did you mean geometry_msgs/Twist?",
        "error: 'Twist' is not a type name, expected package/Type such as geometry_msgs/Twist",
    ]
    assert (unbuilt.project / "meta" / "messages.txt").read_text() == "std_msgs/String\n"


def test_add_message_reports_the_bad_lines_of_a_definition(tmp_path: Path, unbuilt: Workspace) -> None:
    (tmp_path / ".catkin_workspace").touch()
    unbuilt.add_package("my_robot", {"Cell.msg": "float32 a b\n"})
    result = unbuilt.add_message("my_robot/Cell", "--no-build")
    assert result.returncode == 2
    assert f"error: my_robot/Cell: {tmp_path}/src/my_robot/msg/Cell.msg:1: Invalid" in result.stdout


def test_add_message_states_when_there_is_nothing_to_build(unbuilt: Workspace) -> None:
    result = unbuilt.add_message("std_msgs/Bool")
    assert result.returncode == 1
    assert "is not in a catkin workspace" in result.stdout


def test_add_message_states_that_an_installation_needs_no_lists(tmp_path: Path, unbuilt: Workspace) -> None:
    result = unbuilt.add_message("std_msgs/Bool", "--project", str(tmp_path / "none"))
    assert result.returncode == 2
    assert "an installed bubblesim needs no lists: it reads the definitions of types" in result.stdout


def test_add_message_states_how_the_build_failed(tmp_path: Path, unbuilt: Workspace) -> None:
    (tmp_path / ".catkin_workspace").touch()
    unbuilt.write("bubblesim/CMakeLists.txt", "nonsense(")
    result = unbuilt.add_message("std_msgs/Bool")
    assert result.returncode == 1
    assert f"error: 'catkin_make --directory {tmp_path} --pkg bubblesim' in " in result.stdout


def test_add_message_has_a_help(unbuilt: Workspace) -> None:
    result = unbuilt.add_message("--help")
    assert result.returncode == 0
    assert "exit codes: 0 success, 1 the build failed, 2 bad usage" in result.stdout
