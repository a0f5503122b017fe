# SPDX-License-Identifier: BSD-3-Clause
"""Parts of a session in Python that cannot begin leave no thread, no socket and no script."""

import gc
import sys
import threading
import weakref
from pathlib import Path

import pytest
import zmq

import bubblesim
from bubblesim.remote.server import RemoteServer
from bubblesim.scripting.host import child_script
from bubblesim.scripting.host.host import ScriptHost


def threads() -> list[str]:
    return sorted(thread.name for thread in threading.enumerate())


def descriptors() -> int:
    return len(list(Path("/proc/self/fd").iterdir()))


def no_memory(*_arguments: object, **_named: object) -> None:
    raise MemoryError


def test_scripts_that_cannot_be_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "script.py"
    file.write_text("#python\ndef sysCall_init():\n    pass\n")
    runner = bubblesim.Runner(bubblesim.Simulation("ball"))
    host = ScriptHost(runner, None, [("/Ball", file)], [])
    before = threads()
    monkeypatch.setattr(child_script.ChildScript, "_warn_of_unknown_callbacks", no_memory)
    with pytest.raises(MemoryError):
        host.start()
    assert threads() == before
    assert "child_script_Ball" not in sys.modules
    known = weakref.ref(host)
    del host
    gc.collect()
    assert known() is None


def test_a_server_without_its_last_socket(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(zmq.Socket, "get_monitor_socket", no_memory)
    before = threads(), descriptors()
    with pytest.raises(MemoryError):
        RemoteServer("127.0.0.1", None, no_memory, socket=str(tmp_path / "api"))
    gc.collect()
    assert (threads(), descriptors()) == before


def test_a_server_whose_second_path_is_taken(tmp_path: Path) -> None:
    (tmp_path / "api-control").mkdir()
    before = threads(), descriptors()
    with pytest.raises(zmq.ZMQError):
        RemoteServer("127.0.0.1", None, no_memory, socket=str(tmp_path / "api"))
    gc.collect()
    assert (threads(), descriptors()) == before
