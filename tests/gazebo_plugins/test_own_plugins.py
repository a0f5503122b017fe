# SPDX-License-Identifier: BSD-3-Clause
"""Plugins of packages of the user: in Python, and in C++ built by catkin in a workspace that extends this one."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from launch_support import with_packages
from node_support import write
from ros_support import built

FAILING = """
from bubblesim.gazebo_plugins.plugin import Plugin


class Failing(Plugin):
    acts_without_ros = True

    def actuate(self):
        raise LookupError("out of fuel")


class Closing(Plugin):
    acts_without_ros = True

    def actuate(self):
        raise LookupError("first")

    def close(self):
        raise LookupError("second")


class NoPlugin:
    pass
"""
FAILING_DEVICE = """
#include <stdexcept>

namespace thruster {
class Failing : public bubblesim::PluginDevice {
 public:
  void load(const bubblesim::PluginPlace& place) override { fails_ = place.parameters.flag("fails", false); }
  void update(bubblesim::World&, double time, double) override {
    if (fails_ && time > 0.9) throw std::runtime_error("out of fuel");
  }

 private:
  bool fails_ = false;
};
class Refusing : public Failing {
 public:
  void load(const bubblesim::PluginPlace&) override { throw std::runtime_error("no licence"); }
};
}  // namespace thruster
PLUGINLIB_EXPORT_CLASS(thruster::Failing, bubblesim::PluginDevice)
PLUGINLIB_EXPORT_CLASS(thruster::Refusing, bubblesim::PluginDevice)
"""
WORLD = """\
<sdf version="1.9"><world name="w">
  <model name="Ball">
    <pose>0 0 5 0 0 0</pose>
    <link name="body"><collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link>
    {plugins}
  </model>
</world></sdf>
"""


def run(command: list[object], env: dict[str, str], folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(part) for part in command],
        env=env,
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )


def simulated(env: dict[str, str], folder: Path, plugins: str, *options: str) -> subprocess.CompletedProcess[str]:
    file = write(folder / "scene.sdf", WORLD.format(plugins=plugins))
    return run([built("sim"), file, "--no-ros", "--speed", "max", "--until", "1.5", *options], env, folder)


@pytest.fixture(scope="module")
def python_package(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """Return the folder of a new package, and an environment in which ROS finds it, without a build."""
    folder = tmp_path_factory.mktemp("packages")
    env = with_packages(dict(os.environ), folder)
    made = run([built("bubblesim"), "new-plugin", "thruster", "--python"], env, folder)
    assert made.returncode == 0, made.stderr
    assert "bubblesim test thruster/test" in made.stderr
    write(folder / "thruster" / "src" / "thruster" / "failing.py", FAILING)
    manifest = folder / "thruster" / "package.xml"
    names = ["failing:Failing", "failing:Closing", "failing:NoPlugin", "missing:Missing"]
    exports = "".join(f'<bubblesim python_plugin="thruster.{name}"/>' for name in names)
    manifest.write_text(manifest.read_text().replace("<export>", f"<export>{exports}"))
    return folder, env


def test_a_new_package_in_python_passes_its_tests_as_it_is(python_package: tuple[Path, dict[str, str]]) -> None:
    folder, env = python_package
    tested = run([built("bubblesim"), "test", "thruster/test"], env, folder)
    assert tested.returncode == 0, tested.stdout + tested.stderr
    assert "3 passed" in tested.stdout


def test_a_plugin_that_raises_is_reported_with_its_model_and_line_and_the_others_go_on(
    python_package: tuple[Path, dict[str, str]],
) -> None:
    folder, env = python_package
    plugins = """
    <plugin name="bad" filename="thruster.failing:Failing"/>
    <plugin name="worse" filename="thruster.failing:Closing"/>
    <plugin name="good" filename="thruster.plugin:Thruster"><force>5</force></plugin>"""
    ended = simulated(env, folder, plugins)
    assert ended.returncode == 0, ended.stderr
    place = r"\(\S*/thruster/src/thruster/failing\.py:9\)"
    expected = (
        rf"error: \S+scene\.sdf:6: plugin 'bad' \(thruster\.failing:Failing\) of /Ball failed in actuate {place} "
    )
    assert len(re.findall(expected + "and is disabled: out of fuel", ended.stderr)) == 1, ended.stderr
    assert "plugin 'worse' (thruster.failing:Closing) failed in close" in ended.stderr
    assert "'good'" not in ended.stderr


@pytest.mark.parametrize(
    ("filename", "problem"),
    [
        ("thruster.failing:NoPlugin", "it is no subclass of bubblesim.gazebo_plugins.plugin.Plugin"),
        ("thruster.missing:Missing", "it cannot be imported: No module named 'thruster.missing'"),
        ("thruster.plugin:Thrust", 'package.xml does not export it: it needs <export><bubblesim python_plugin="thru'),
        ("nowhere.plugin:Mine", "there is no package nowhere on ROS_PACKAGE_PATH"),
        ("os:PathLike", "there is no package os on ROS_PACKAGE_PATH"),
    ],
)
def test_a_class_that_cannot_be_loaded_is_an_error_that_states_why(
    python_package: tuple[Path, dict[str, str]], filename: str, problem: str
) -> None:
    folder, env = python_package
    ended = simulated(env, folder, f'<plugin name="mine" filename="{filename}"/>')
    assert ended.returncode == 0, ended.stderr
    assert f"scene.sdf:5: plugin 'mine' ({filename}): " in ended.stderr
    assert problem in ended.stderr


def test_an_entry_point_of_a_distribution_names_a_plugin(
    python_package: tuple[Path, dict[str, str]], tmp_path: Path
) -> None:
    folder, env = python_package
    info = tmp_path / "mine-1.0.dist-info"
    info.mkdir()
    write(info / "METADATA", "Metadata-Version: 2.1\nName: mine\nVersion: 1.0\n")
    write(info / "entry_points.txt", "[bubblesim.plugins]\nfailing = thruster.failing:Failing\n")
    paths = [str(tmp_path), str(folder / "thruster" / "src"), env.get("PYTHONPATH", "")]
    env = {**env, "PYTHONPATH": ":".join(filter(None, paths))}
    ended = simulated(env, folder, '<plugin name="mine" filename="failing"/>')
    assert "plugin 'mine' (failing) of /Ball failed in actuate" in ended.stderr


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    """Return the folder of a built workspace with a new package, and the environment that its setup.bash makes."""
    folder = tmp_path_factory.mktemp("workspace")
    (folder / "src").mkdir()
    made = run([built("bubblesim"), "new-plugin", "thruster", "--cpp"], dict(os.environ), folder / "src")
    assert made.returncode == 0, made.stderr
    package = folder / "src" / "thruster"
    source = package / "src" / "plugin.cpp"
    source.write_text(source.read_text() + FAILING_DEVICE)
    classes = package / "plugins.xml"
    for name in ("Failing", "Refusing"):
        more = f'<class name="thruster/{name}" type="thruster::{name}" base_class_type="bubblesim::PluginDevice"/>'
        classes.write_text(classes.read_text().replace("</library>", f"{more}</library>"))
    for command in (["catkin", "init"], ["catkin", "build", "--no-status", "--no-notify"]):
        result = run(command, {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}, folder)
        assert result.returncode == 0, result.stdout + result.stderr
    printed = run(["bash", "-c", "source devel/setup.bash && env -0"], dict(os.environ), folder).stdout
    return folder, dict(line.split("=", 1) for line in printed.split("\0") if line)


def test_a_new_package_in_cpp_passes_its_tests(workspace: tuple[Path, dict[str, str]]) -> None:
    folder, env = workspace
    tested = run([built("bubblesim"), "test", "src/thruster/test"], env, folder)
    assert tested.returncode == 0, tested.stdout + tested.stderr
    assert "3 passed" in tested.stdout


def test_a_device_that_throws_is_reported_with_its_model_and_the_others_go_on(
    workspace: tuple[Path, dict[str, str]],
) -> None:
    folder, env = workspace
    plugins = """
    <plugin name="thruster/Failing" filename="libthruster.so"><fails>true</fails><fail>1</fail></plugin>
    <plugin name="thruster::Refusing" filename="libthruster.so"/>
    <plugin name="third" filename="libthruster.so"/>
    <plugin name="thruster::Thruster" filename="libthruster.so"><link>bodi</link></plugin>"""
    ended = simulated(env, folder, plugins)
    assert ended.returncode == 0, ended.stderr
    file = folder / "scene.sdf"
    shown = f"{file}:6: plugin 'thruster/Failing' (libthruster.so)"
    expected = [
        f"warning: {shown} has unknown parameters: fail",
        f"error: {shown} of /Ball failed in a physics substep and is disabled: update(): out of fuel",
        f"error: {file}:7: plugin 'thruster::Refusing' (libthruster.so): load(): no licence",
        f"error: {file}:8: plugin 'third' (libthruster.so): the library has several devices: the name of the <plugin> "
        "must be one of thruster/Thruster, thruster/Failing, thruster/Refusing",
        f"error: {file}:9: plugin 'thruster::Thruster': <link> is 'bodi', which is not a link of /Ball; did you mean "
        "body?",
    ]
    assert sorted(ended.stderr.splitlines()) == sorted(expected)


def test_a_library_that_is_not_built_is_an_error(workspace: tuple[Path, dict[str, str]], tmp_path: Path) -> None:
    folder, env = workspace
    package = tmp_path / "other"
    package.mkdir()
    write(package / "package.xml", (folder / "src/thruster/package.xml").read_text().replace("thruster", "other"))
    write(package / "plugins.xml", (folder / "src/thruster/plugins.xml").read_text().replace("thruster", "other"))
    plugin = '<plugin name="other/Thruster" filename="libother.so"/>'
    ended = simulated(with_packages(env, tmp_path), tmp_path, plugin)
    assert f"libother.so of {package} is not there: build the package" in ended.stderr
