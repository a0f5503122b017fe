# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of child scripts, with a real master and rosparam."""

from collections.abc import Callable
from pathlib import Path

from node_support import NAME, Node, write
from ros_support import RosCore, free_port, ros_environment, wait_until

Script = Callable[[str], Node]


def test_values_are_converted_as_roscpp_does(script: Script, roscore: RosCore) -> None:
    for name, value in {"b": True, "i": 7, "d": 2.5, "s": "text", "l": [1, 2]}.items():
        roscore.set_param(f"/{name}", value)
    node = script("""\
        def sysCall_init():
            assert simROS.getParamBool('/b') == (True, True)
            assert simROS.getParamInt('/i') == (True, 7)
            assert simROS.getParamDouble('/i') == (True, 7.0)
            assert simROS.getParamDouble('/d') == (True, 2.5)
            assert simROS.getParamInt('/d') == (True, 3)
            assert simROS2.getParamString('/s', 'x') == (True, 'text')
            assert simROS.getParamInt('/s', 9) == (False, 9)
            assert simROS.getParamInt('/b', 9) == (False, 9)
            assert simROS.getParamString('/l', 'x') == (False, 'x')
            assert simROS.getParamString('/nothing', 'x') == (False, 'x')
            assert simROS.hasParam('/l') and not simROS.hasParam('/nothing')
            print('done')
        """)
    node.wait_for_output("done")
    assert "parameter '/s' is a string ('text'), not an int: using the default" in node.output
    assert "parameter '/l' is a list or a dictionary, not a string: using the default" in node.output


def test_names_are_below_the_node_and_found_upwards(script: Script, roscore: RosCore) -> None:
    roscore.set_param("/speed", 1.5)
    node = script("""\
        def sysCall_init():
            assert simROS.searchParam('speed') == (True, '/speed')
            assert simROS.searchParam('nothing') == (False, '')
            simROS.setParamInt('speed', 2)
            assert simROS.searchParam('speed') == (True, '/sim_ros_interface/speed')
            assert simROS.getParamInt('~speed') == (True, 2)
            simROS.setParamBool('gone', True)
            simROS.deleteParam('gone')
            assert not simROS.hasParam('gone')
            simROS.setParamString('/text', 'grüezi')
            simROS.setParamDouble('/number', 1)
            print('done')
        """)
    node.wait_for_output("done")
    wait_until(lambda: "/number" in roscore.run("rosparam", "list"), "the parameters to be set")
    assert roscore.run("rosparam", "get", f"{NAME}/speed") == "2\n"
    assert roscore.run("rosparam", "get", "/number") == "1.0\n"
    assert "/sim_ros_interface/gone" not in roscore.run("rosparam", "list")


def test_a_master_that_hangs_holds_a_script_up_once(script: Script, roscore: RosCore) -> None:
    roscore.set_param("/x", 5)
    node = script("""\
        import time
        def sysCall_init():
            self.waits = []
        def sysCall_actuation():
            begin = time.monotonic()
            exists, value = simROS.getParamInt('/x', -1)
            if exists and self.waits:
                print('back', value, 'long waits:', len([wait for wait in self.waits if wait > 0.5]))
                self.waits.clear()
            if not exists:
                self.waits.append(time.monotonic() - begin)
                if len(self.waits) == 10:
                    print('missed')
            elif sim.getSimulationTime() > 0.2:
                print('running')
        """)
    node.wait_for_output("running")
    roscore.pause()
    node.wait_for_output("missed")
    roscore.resume()
    node.wait_for_output("back 5 long waits: 1")
    assert node.output.count("does not answer: no parameter exists") == 1


def test_wrong_values_are_reported(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            for wrong in (lambda: simROS.setParamInt('/x', 2**31), lambda: simROS.setParamString('/x', 5),
                          lambda: simROS.setParamDouble('/x', '5'), lambda: simROS.getParamInt('a b')):
                try:
                    wrong()
                except (TypeError, ValueError) as error:
                    print('reported:', error)
            print('done')
        """)
    node.wait_for_output("done")
    assert node.output.count("reported: ") == 4
    assert "invalid parameter name 'a b'" in node.output


def test_without_a_master_nothing_exists_and_the_script_runs_on(tmp_path: Path) -> None:
    file = write(
        tmp_path / "script.py",
        """\
        def sysCall_init():
            simROS.setParamInt('/x', 5)
            print('read', simROS.getParamInt('/x', 7), simROS.hasParam('/x'), simROS.searchParam('x'))
        """,
    )
    env = ros_environment(free_port(), tmp_path)
    with Node(env, tmp_path / "log", "ball", "--child-script", f"/Ball={file}") as node:
        node.wait_for_output("read (False, 7) False (False, '')")
        assert "does not answer: no parameter exists" in node.output
        assert node.end() == 0
