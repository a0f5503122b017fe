# SPDX-License-Identifier: BSD-3-Clause
"""Broken xacro files are refused with an error of the scene that names the file."""

from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import given, settings

import bubblesim
from damaged_text import damaged
from node_support import write

ROBOT = """\
<robot name="bot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="radius" default="0.5"/>
  <xacro:property name="mass" value="${2 * pi}"/>
  <xacro:macro name="wheel" params="name *origin">
    <link name="${name}"><collision><xacro:insert_block name="origin"/>
      <geometry><sphere radius="$(arg radius)"/></geometry></collision></link>
  </xacro:macro>
  <xacro:if value="${mass > 1}"><xacro:wheel name="left"><origin xyz="0 0 1"/></xacro:wheel></xacro:if>
</robot>
"""


def refusal_of(file: Path) -> str:
    """Return why a file is refused; nothing if it is read."""
    try:
        bubblesim.Scene(str(file))
    except bubblesim.SceneError as error:
        return str(error)
    return ""


@settings(max_examples=15)  # a process each
@given(damaged([ROBOT]))
def test_a_damaged_file_is_read_or_refused(text: str) -> None:
    with TemporaryDirectory() as folder:
        file = Path(folder, "robot.urdf.xacro")
        file.write_bytes(text.encode(errors="surrogatepass"))
        refusal = refusal_of(file)
        assert not refusal or "robot.urdf.xacro" in refusal


def test_the_file_is_valid_before(tmp_path: Path) -> None:
    assert bubblesim.Scene(str(write(tmp_path / "robot.urdf.xacro", ROBOT)))
