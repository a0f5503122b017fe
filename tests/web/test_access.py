# SPDX-License-Identifier: BSD-3-Clause
"""Who may use the server of the window."""

import http.client
import os
import re
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from ros_support import free_port, start, stop, wait_until
from web_support import PATIENCE, Node, Window


@pytest.fixture(scope="module")
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Node]:
    with Node(tmp_path_factory.mktemp("node"), "tricycle", "--paused") as running:
        yield running


def status(node: Node, path: str, **headers: str) -> tuple[int, dict[str, str]]:
    where = node.origin.removeprefix("http://")
    connection = http.client.HTTPConnection(where, timeout=20)
    connection.putrequest("GET", path, skip_host=True)
    for name, value in ({"Host": where} | {name.replace("_", "-"): value for name, value in headers.items()}).items():
        connection.putheader(name, value)
    connection.endheaders()
    answer = connection.getresponse()
    return answer.status, dict(answer.getheaders())


def cookie(node: Node) -> str:
    code, headers = status(node, node.address.removeprefix(node.origin))
    assert code == 302
    assert headers["Location"] == "/"
    assert "HttpOnly" in headers["Set-Cookie"]
    assert "SameSite=Strict" in headers["Set-Cookie"]
    return headers["Set-Cookie"].partition(";")[0]


def test_nothing_is_served_without_the_token(node: Node) -> None:
    for path in ("/", "/main.js", "/socket", "/?token=wrong"):
        assert status(node, path)[0] == 403
    code, headers = status(node, "/", Cookie=cookie(node))
    assert code == 200
    assert "default-src 'self'" in headers["Content-Security-Policy"]


def test_other_names_and_other_sites_are_refused(node: Node) -> None:
    known = cookie(node)
    port = node.origin.rpartition(":")[2]
    assert status(node, "/", Cookie=known, Host=f"attacker.example:{port}")[0] == 403
    assert status(node, "/", Cookie=known, Origin="http://attacker.example")[0] == 403
    upgrade = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec_WebSocket_Version": "13"}
    upgrade["Sec_WebSocket_Key"] = "AAAAAAAAAAAAAAAAAAAAAA=="
    assert status(node, "/socket", Cookie=known, **upgrade)[0] == 403  # no Origin
    assert status(node, "/socket", Cookie=known, Origin="http://127.0.0.1:1", **upgrade)[0] == 403
    assert status(node, "/socket", Cookie=known, Origin=node.origin, **upgrade)[0] == 101


def test_files_outside_of_the_page_are_not_served(node: Node) -> None:
    known = cookie(node)
    for path in ("/../package.xml", "/%2e%2e/package.xml", "/..%2f..%2fpackage.xml"):
        assert status(node, path, Cookie=known)[0] in (403, 404)


def test_servers_that_begin_together_have_ports_of_their_own(tmp_path: Path) -> None:
    command = ["bubblesim", "view", "--door", str(free_port())]
    logs = [tmp_path / f"{number}.txt" for number in range(6)]
    with ExitStack() as ends:
        for log in logs:
            with log.open("w") as output:
                ends.callback(stop, start(command, dict(os.environ), stderr=output))
        wait_until(lambda: all(log.read_text().endswith("\n") for log in logs), "all servers", timeout=PATIENCE / 1000)
    found = [re.findall(r"the window is at http://127.0.0.1:(\d+)/", log.read_text()) for log in logs]
    assert all(len(ports) == 1 for ports in found), found
    assert len({ports[0] for ports in found}) == len(logs)


def test_a_window_that_only_looks_changes_nothing(tmp_path: Path, show: Callable[..., Window]) -> None:
    with Node(tmp_path, "tricycle", "--paused", "--web-edit=false") as node:
        page = show(node)
        assert page.button("Play").is_disabled()
        handle = page.js("bubblesim.scene.byPath('/Tricycle').handle")
        assert page.call("sim.getObjectPosition", handle)
        for function, arguments in [
            ("window.start", []),
            ("window.set_pose", [handle, [0, 0, 0, 0, 0, 0, 1]]),
            ("sim.startSimulation", []),
            ("sim.setObjectPosition", [handle, [0, 0, 0]]),
            ("sim.getRandom", []),
            ("zmqRemoteApi.require", ["sim"]),
        ]:
            answer = page.page.evaluate(
                "([name, args]) => bubblesim.link.call(name, args).then(() => 'done', (error) => error.message)",
                [function, arguments],
            )
            assert "may only look" in answer
