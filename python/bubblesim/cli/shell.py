# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim shell: a Python prompt with `sim` on a running simulator."""

from __future__ import annotations

import argparse
import atexit
import code
import contextlib
import os
import re
import readline
import rlcompleter
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from bubblesim.remote.connection import Connection
from bubblesim.running.places import node_program
from bubblesim.running.processes import RunError

_DESCRIPTION = """\
Opens a Python prompt with `sim`, whose functions act on a simulator: `help(sim.getObject)` shows one, Tab completes,
Ctrl-C ends a call that waits, Ctrl-D ends the prompt.

  bubblesim shell tricycle --no-ros       on a node of its own, which ends with the prompt
  bubblesim shell --port 23000            on a node that was started with --remote"""
_ANSWER = re.compile(r"remote clients can connect to tcp://[^ ]*:(\d+)")
_TIMEOUT = 60.0  # s for the node to open its port, or to end
_LONGEST_CALL = 1e6  # s; Ctrl-C ends it before
_MOST_LINES = 10_000  # of the history


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "shell",
        help="open a Python prompt on a simulator",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="bubblesim shell [SCENE [option of the node ...]] [--port PORT [--token FILE]]",
        allow_abbrev=False,
    )
    parser.add_argument("scene", metavar="SCENE", nargs="?", help="start a node with this scene; default: an empty one")
    parser.add_argument("--port", type=int, help="use the node that listens on this port")
    parser.add_argument("--token", metavar="FILE", type=Path, help="token of a node that runs with --remote-token=FILE")
    parser.set_defaults(command=_open, parser=parser, other_options=[])


def _open(options: argparse.Namespace) -> int:
    if options.port is not None and (options.scene or options.other_options):
        raise ValueError("give either the scene for a new node, or the --port of a running one")
    if options.port is None and options.token is not None:
        raise ValueError("--token belongs to a running node: give its --port")
    signal.signal(signal.SIGINT, signal.default_int_handler)  # the program ends by it otherwise
    with contextlib.ExitStack() as stack:
        node = None
        port, token = options.port, options.token
        if port is None:
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="bubblesim-shell-"))
            token = Path(folder) / "token"  # the shell alone may use its node
            node, port = stack.enter_context(_started_node([options.scene] if options.scene else [], token, options))
        try:
            connection = stack.enter_context(_ShellConnection(port, timeout=5.0, token=token))
        except TimeoutError as error:
            raise RunError(str(error)) from None
        _Prompt(connection, node).interact(f"sim: the simulator on port {port}; Ctrl-D ends", exitmsg="")
    return 0


@contextlib.contextmanager
def _started_node(
    scene: list[str], token: Path, options: argparse.Namespace
) -> Iterator[tuple[subprocess.Popen[str], int]]:
    """Run a node of its own process group, which Ctrl-C does not reach; yield it and the port of its remote API."""
    command = [str(node_program()), *scene, *options.other_options, "--remote=0", f"--remote-token={token}"]
    node = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, process_group=0)
    try:
        assert node.stderr is not None
        port = _port_of(node.stderr)
        if port is None:
            raise RunError(f"the simulator ended with exit code {node.wait(_TIMEOUT)}")
        threading.Thread(target=_pass_on, args=(node.stderr,), daemon=True).start()
        yield node, port
    finally:
        node.terminate()
        node.wait(_TIMEOUT)


def _port_of(output: IO[str]) -> int | None:
    """Copy the output of a node until it contains its port; return None if it ends before."""
    for line in output:
        if found := _ANSWER.search(line):
            return int(found[1])
        print(line, end="", file=sys.stderr, flush=True)
    return None


def _pass_on(output: IO[str]) -> None:
    for line in output:
        print(line, end="", file=sys.stderr, flush=True)


class _ShellConnection(Connection):
    """A connection that can be used again after Ctrl-C."""

    def __init__(self, port: int, *, timeout: float, token: Path | None) -> None:
        super().__init__(port, timeout=timeout, token=token)
        self._timeout = _LONGEST_CALL

    def call(self, function: str, *arguments: Any) -> Any:
        """See Connection.call."""
        try:
            return super().call(function, *arguments)
        except KeyboardInterrupt:
            self._renew()
            raise

    def _renew(self) -> None:
        """Go on with a new socket: the old one waits for a reply. The client, with its stepping mode, stays."""
        old = self._socket
        self._socket = self._open_socket()
        self._socket.connect(f"tcp://{self._address}")
        with contextlib.suppress(KeyboardInterrupt):
            super().call("sim.getSimulationState")  # before the old socket is closed: the server knows the new one
        old.close()


class _Prompt(code.InteractiveConsole):
    """Shows the errors of the simulator in one line."""

    def __init__(self, connection: Connection, node: subprocess.Popen[str] | None) -> None:
        super().__init__({"sim": connection.sim, "simulator": connection})
        self._node = node
        _prepare_line_editing(self.locals)

    def raw_input(self, prompt: str = "") -> str:
        """Read a line; end when the node has ended."""
        if self._node is not None and self._node.poll() is not None:
            self.write("the simulator has ended\n")
            raise EOFError
        return super().raw_input(prompt)

    def showtraceback(self) -> None:
        """Show the last error; of a call of the simulator without the lines of this program."""
        error = sys.exception()
        if type(error) in (RuntimeError, TimeoutError):
            self.write(f"{type(error).__name__}: {error}\n")
        else:
            super().showtraceback()


def _prepare_line_editing(names: Any) -> None:
    if not sys.stdin.isatty():
        return
    readline.set_completer(rlcompleter.Completer(names).complete)
    readline.parse_and_bind("tab: complete")
    state = Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state")
    history = state / "bubblesim" / "shell_history"
    with contextlib.suppress(OSError):  # there is none yet
        readline.read_history_file(history)
    readline.set_history_length(_MOST_LINES)
    atexit.register(_keep_history, history)


def _keep_history(file: Path) -> None:
    with contextlib.suppress(OSError):  # it is a convenience
        file.parent.mkdir(parents=True, exist_ok=True)
        readline.write_history_file(file)
