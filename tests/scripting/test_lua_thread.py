# SPDX-License-Identifier: BSD-3-Clause
"""A Lua thread, from the Python functions that it calls."""

import time

import pytest

from bubblesim.scripting.threads import script_thread
from bubblesim.scripting.threads.lua_thread import LuaThread


def test_what_python_does_for_it_may_sleep(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time, "sleep", time.sleep)  # install() replaces it, and the end of the test restores it
    script_thread.install()
    slept = []

    def resume() -> bool:
        time.sleep(0.001)  # like a called service of another script
        slept.append(True)
        return True

    LuaThread(resume).run_turn()
    assert slept == [True]
