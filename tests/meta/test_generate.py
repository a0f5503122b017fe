# SPDX-License-Identifier: BSD-3-Clause
import os

import pytest

from generator_support import Generator


def test_three_typos_are_reported_at_once_with_place_and_hint(generator: Generator) -> None:
    run = generator.run("geometry_msgs/Twits\n# a comment\nsensor_msg/Image\n\nstd_msgs/String\nstdmsgs/flaot32\n")
    assert run.returncode == 1
    assert run.stderr.splitlines() == [
        "meta/messages.txt:1: geometry_msgs has no message Twits; did you mean geometry_msgs/Twist?",
        "meta/messages.txt:3: package sensor_msg is not found; did you mean sensor_msgs/Image?",
        "meta/messages.txt:6: package stdmsgs is not found; did you mean std_msgs/Float32?",
    ]


def test_nothing_is_written_when_there_are_problems(generator: Generator) -> None:
    generator.run("geometry_msgs/Twits\nstd_msgs/String\n")
    assert not generator.output.exists()


@pytest.mark.parametrize(
    "line", ["Twist", "geometry_msgs/", "geometry_msgs/Twist Pose", "geometry_msgs\\Twist", "a/b/C"]
)
def test_malformed_lines_are_reported(generator: Generator, line: str) -> None:
    run = generator.run(f"std_msgs/String\n{line}\n")
    assert run.returncode == 1
    assert run.stderr.startswith(f"meta/messages.txt:2: '{line}' is not a type name, expected package/Type")


def test_a_type_listed_twice_is_a_warning_with_both_places(generator: Generator) -> None:
    run = generator.run("std_msgs/String\nstd_msgs/Bool\nstd_msgs/msg/String\n")
    assert run.returncode == 0
    assert run.stderr.strip() == (
        "warning: meta/messages.txt:3: std_msgs/String is listed twice, first at meta/messages.txt:1; "
        "the first line counts"
    )
    assert generator.table("std_msgs").count('"std_msgs/String",') == 1


def test_comments_blank_lines_and_both_spellings_are_allowed(generator: Generator) -> None:
    run = generator.run("# all\n\n  std_msgs/String  # text\nstd_msgs/msg/Bool\n", "std_srvs/srv/SetBool\n")
    assert run.returncode == 0, run.stderr
    assert '"std_msgs/Bool"' in generator.table("std_msgs")


def test_a_service_among_the_messages_is_sent_to_its_list(generator: Generator) -> None:
    run = generator.run("std_srvs/SetBool\n")
    assert run.stderr.strip() == "meta/messages.txt:1: std_srvs/SetBool is a service: list it in meta/services.txt"


def test_typos_in_services_are_reported_too(generator: Generator) -> None:
    run = generator.run("std_msgs/String\n", "std_srvs/SetBol\n")
    assert run.stderr.strip() == ("meta/services.txt:1: std_srvs has no service SetBol; did you mean std_srvs/SetBool?")


def test_an_unknown_package_that_resembles_none_comes_with_a_cure(generator: Generator) -> None:
    run = generator.run("quantum_teleport_msgs/Beam\n")
    assert "package quantum_teleport_msgs is not found; install ros-quantum-teleport-msgs or" in run.stderr


def test_nested_types_come_along(generator: Generator) -> None:
    generator.run("geometry_msgs/PoseStamped\n")
    assert '"geometry_msgs/Quaternion"' in generator.table("geometry_msgs")
    assert '"std_msgs/Header"' in generator.table("std_msgs")


def test_only_changed_files_are_written_again(generator: Generator) -> None:
    generator.run("geometry_msgs/Twist\nstd_msgs/String\n")
    for path in generator.output.iterdir():
        os.utime(path, (1, 1))
    generator.run("geometry_msgs/Twist\nstd_msgs/String\nstd_msgs/Bool\n")
    written = {path.name for path in generator.output.iterdir() if path.stat().st_mtime > 1}
    assert written == {"package_std_msgs.cpp", "tables.cmake"}


def test_files_of_packages_no_longer_listed_are_removed(generator: Generator) -> None:
    generator.run("geometry_msgs/Twist\nstd_msgs/String\n")
    generator.run("geometry_msgs/Twist\n")
    assert not (generator.output / "package_std_msgs.cpp").exists()


def test_everything_that_was_read_is_a_dependency_of_the_build(generator: Generator) -> None:
    generator.run("geometry_msgs/Twist\n", "std_srvs/Empty\n")
    manifest = (generator.output / "tables.cmake").read_text()
    for name in ["meta/messages.txt", "meta/services.txt", "geometry_msgs/msg/Vector3.msg", "std_srvs/srv/Empty.srv"]:
        assert f'{name}"\n' in manifest


@pytest.mark.parametrize("marker", [".catkin_tools", ".catkin_workspace"])
def test_types_of_the_users_workspace_are_found_by_the_build_folder(generator: Generator, marker: str) -> None:
    (generator.folder / marker).mkdir()
    generator.add_package("src/deep/er", "my_robot", {"msg/Battery.msg": "Cell[] cells\n", "msg/Cell.msg": "float32 v"})
    run = generator.run("my_robot/Battery\n")
    assert run.returncode == 0, run.stderr
    assert '"my_robot/Cell"' in generator.table("my_robot")


def test_a_configured_source_space_is_found(generator: Generator) -> None:
    profile = generator.folder / ".catkin_tools" / "profiles" / "default"
    profile.mkdir(parents=True)
    (profile / "config.yaml").write_text("build_space: build\nsource_space: sources\n")
    generator.add_package("sources", "my_robot", {"msg/Cell.msg": "float32 v\n"})
    assert generator.run("my_robot/Cell\n").returncode == 0


def test_the_users_package_wins_over_the_projects_own(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    generator.add_package("src", "test_msgs", {"msg/Notification.msg": "string mine\n"})
    generator.run("test_msgs/Notification\n")
    assert '{"mine",' in generator.table("test_msgs")


def test_the_projects_own_packages_are_found(generator: Generator) -> None:
    generator.run("test_msgs/Notification\n")
    assert '{"messages",' in generator.table("test_msgs")


def test_packages_on_ros_package_path_are_found(generator: Generator) -> None:
    generator.add_package("elsewhere", "my_robot", {"msg/Cell.msg": "float32 v\n"})
    assert generator.run("my_robot/Cell\n", "", "--ros-package-path", f"{generator.folder}/elsewhere").returncode == 0


def test_source_spaces_of_a_devel_space_are_found(generator: Generator) -> None:
    generator.add_package("other/src", "my_robot", {"msg/Cell.msg": "float32 v\n"})
    devel = generator.folder / "other" / "devel"
    devel.mkdir()
    (devel / ".catkin").write_text(f"{generator.folder}/other/src")
    assert generator.run("my_robot/Cell\n", "", "--prefix-path", str(devel)).returncode == 0


def test_installed_share_folders_are_found(generator: Generator) -> None:
    generator.add_package("install/share", "my_robot", {"msg/Cell.msg": "float32 v\n"})
    assert generator.run("my_robot/Cell\n", "", "--prefix-path", f"{generator.folder}/install").returncode == 0


def test_a_missing_nested_type_names_the_chain(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    files = {"msg/Outer.msg": "Inner inner\n", "msg/Inner.msg": "other_pkg/Gone gone\n"}
    package = generator.add_package("src", "my_robot", files)
    assert generator.run("my_robot/Outer\n").stderr.strip() == (
        "meta/messages.txt:1: other_pkg/Gone, used in my_robot/Outer > my_robot/Inner "
        f"({package}/msg/Inner.msg:1), is not found; "
        "install its package or add it to the workspace"
    )


def test_a_type_that_contains_itself_is_reported(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    generator.add_package("src", "my_robot", {"msg/A.msg": "B b\n", "msg/B.msg": "A[] a\n"})
    error = "meta/messages.txt:1: my_robot/A contains itself: my_robot/A > my_robot/B > my_robot/A"
    assert generator.run("my_robot/A\n").stderr.strip() == error


def test_all_bad_lines_of_a_definition_are_reported_with_their_place(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    text = "float32 a b c\nint8 fine\nint8 LIMIT=400\nint16 fine\n"
    package = generator.add_package("src", "my_robot", {"msg/Bad.msg": text})
    first, second, third = generator.run("my_robot/Bad\n").stderr.splitlines()
    assert first.startswith(f"meta/messages.txt:1: my_robot/Bad: {package}/msg/Bad.msg:1: Invalid declaration: float32")
    assert second.startswith(f"{package}/msg/Bad.msg:3: Invalid constant value: cannot coerce [400]")
    assert third.startswith(f"{package}/msg/Bad.msg:4: ")
    assert "fine" in third


def test_bad_lines_of_a_service_are_counted_through_both_halves(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    package = generator.add_package("src", "my_robot", {"srv/Bad.srv": "int8 a\n---\nint8 a\nint8 a a\n"})
    error = generator.run("", "my_robot/Bad\n").stderr
    assert error.startswith(f"meta/services.txt:1: my_robot/Bad: {package}/srv/Bad.srv:4: Invalid declaration")


def test_a_misspelt_builtin_type_is_recognised(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    generator.add_package("src", "my_robot", {"msg/Cell.msg": "flaot32[4] v\n"})
    assert "Cell.msg:1), is not found; did you mean float32?" in generator.run("my_robot/Cell\n").stderr


def test_definitions_may_have_comments_in_any_encoding(generator: Generator) -> None:
    (generator.folder / ".catkin_workspace").touch()
    package = generator.add_package("src", "my_robot", {"msg/Cell.msg": ""})
    (package / "msg" / "Cell.msg").write_bytes(b"float32 v  # in \xb5V\r\n")
    assert generator.run("my_robot/Cell\n").returncode == 0


def test_a_cpp_header_is_enough(generator: Generator) -> None:
    header = generator.folder / "prefix" / "include" / "my_robot" / "Cell.h"
    header.parent.mkdir(parents=True)
    header.write_text(
        "template<class A>\nstruct Definition< ::my_robot::Cell_<A> >\n{\n  static const char* value()\n  {\n"
        '    return "float32 v # \\"volt\\"\\n"\n"std_msgs/String name\\n"\n"' + "=" * 80 + '\\n"\n'
        '"MSG: std_msgs/String\\n"\n"string data\\n"\n;\n  }\n};\n'
    )
    run = generator.run("my_robot/Cell\n", "", "--prefix-path", f"{generator.folder}/prefix")
    assert run.returncode == 0, run.stderr
    assert r'"float32 v # \"volt\"\n"' in generator.table("my_robot")


def test_a_python_class_is_enough(generator: Generator, monkeypatch: pytest.MonkeyPatch) -> None:
    module = generator.folder / "python" / "my_robot" / "msg" / "_Cell.py"
    module.parent.mkdir(parents=True)
    text = "float32 v\nstd_msgs/String name\n\n" + "=" * 80 + "\nMSG: std_msgs/String\nstring data\n"
    module.write_text(f"raise RuntimeError('run')\nclass Cell:\n    _full_text = {text!r}\n")
    monkeypatch.setenv("PYTHONPATH", str(generator.folder / "python"))
    run = generator.run("my_robot/Cell\n")
    assert run.returncode == 0, run.stderr
    assert '"std_msgs/String name\\n"' in generator.table("my_robot")


def test_help_names_the_options(generator: Generator) -> None:
    assert "--ros-package-path" in generator.run("", "", "--help").stdout


def test_the_list_of_interfaces_adds_messages_and_services(generator: Generator) -> None:
    generator.folder.joinpath("interfaces.txt").write_text("geometry_msgs/msg/Twist\nstd_srvs/srv/SetBool\n# none\n")
    run = generator.run("std_msgs/String\ngeometry_msgs/Twist\n", "", "--interfaces", "interfaces.txt")
    assert run.returncode == 0, run.stderr
    assert '"geometry_msgs/Twist"' in generator.table("geometry_msgs")
    assert '"std_srvs/SetBool"' in generator.table("std_srvs")


def test_typos_among_the_interfaces_are_reported_with_their_place(generator: Generator) -> None:
    generator.folder.joinpath("interfaces.txt").write_text("std_srvs/srv/SetBol\ngeometry_msgs/msg/Twits\n")
    run = generator.run("std_msgs/String\n", "", "--interfaces", "interfaces.txt")
    assert run.returncode == 1
    assert run.stderr.splitlines() == [
        "interfaces.txt:2: geometry_msgs has no message Twits; did you mean geometry_msgs/Twist?",
        "interfaces.txt:1: std_srvs has no service SetBol; did you mean std_srvs/SetBool?",
    ]


def test_tables_of_ros2_are_written_on_request(generator: Generator) -> None:
    run = generator.run("sensor_msgs/CameraInfo\nstd_msgs/Time\n", "std_srvs/Trigger\n", "--ros2")
    assert run.returncode == 0, run.stderr
    table = (generator.output / "ros2_package_sensor_msgs.cpp").read_text()
    assert '{"k", FieldKind::kFloat64, ArrayKind::kFixed, 9, 0, 0, nullptr, {}}' in table
    assert (
        '{"stamp", FieldKind::kTime, ArrayKind::kNone, 0, 0, 0, nullptr, {}}'
        in (generator.output / "ros2_package_std_msgs.cpp").read_text()
    )
    assert '"std_msgs/Time"' not in (generator.output / "ros2_package_std_msgs.cpp").read_text()
    generator.run("sensor_msgs/CameraInfo\n")
    assert not (generator.output / "ros2_package_sensor_msgs.cpp").exists()
