# SPDX-License-Identifier: BSD-3-Clause
"""A script that does not return keeps the thread that serves the remote API, but not the window's Stop button."""

from collections.abc import Callable
from pathlib import Path

import pytest

from node_support import write
from web_support import Node, Window

ENDLESS = {
    "script.py": "def sysCall_init(): pass\ndef sysCall_actuation():\n    while True: pass\n",
    "script.lua": "function sysCall_init() end\nfunction sysCall_actuation() while true do end end\n",
}


@pytest.mark.parametrize("name", ENDLESS)
def test_the_stop_button_ends_it(tmp_path: Path, show: Callable[..., Window], name: str) -> None:
    script = write(tmp_path / name, ENDLESS[name])
    with Node(tmp_path, "ball", "--child-script", f"/Ball={script}", "--paused") as node:
        page = show(node)
        page.button("Play").click()
        node.find(r"(has not returned from sysCall_actuation)")
        page.button("Stop").click()
        node.find(r"(was interrupted)")
        assert page.js("bubblesim.link.call('window.share', []).then((scene) => scene !== null)")


def test_a_pause_is_carried_out_when_the_script_returns(tmp_path: Path, show: Callable[..., Window]) -> None:
    code = """
import time
def sysCall_init(): pass
def sysCall_actuation():
    if sim.getSimulationTime() == 0: time.sleep(3)
"""
    script = write(tmp_path / "script.py", code)
    with Node(tmp_path, "ball", "--child-script", f"/Ball={script}", "--paused") as node:
        page = show(node)
        page.button("Play").click()
        node.find(r"(has not returned from sysCall_actuation)")
        assert page.call("window.pause") is None
        assert page.call("sim.getSimulationTime") <= 0.05
