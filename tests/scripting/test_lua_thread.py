# SPDX-License-Identifier: BSD-3-Clause
"""A thread in Lua, as the functions of Python see it that it calls."""

import time

import pytest

from bubblesim.scripting.threads import script_thread
from bubblesim.scripting.threads.lua_thread import LuaThread


def test_what_python_does_for_it_may_sleep(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time, "sleep", time.sleep)  # install() replaces it, and the test's end puts it back
    script_thread.install()
    slept = []

    def resume() -> bool:
        time.sleep(0.001)  # as a service of another script may that it calls
        slept.append(True)
        return True

    LuaThread(resume).give_turn()
    assert slept == [True]
