# SPDX-License-Identifier: BSD-3-Clause
"""Who may use the server of the window."""

import asyncio
import os
import re
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from aiohttp import WSMsgType

from page_client import Server, page_client, websocket
from ros_support import free_port, start, stop, wait_until
from web_support import TIMEOUT, TOKEN, Node, Window

UPGRADE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec_WebSocket_Version": "13",
    "Sec_WebSocket_Key": "AAAAAAAAAAAAAAAAAAAAAA==",
}


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    with Server(tmp_path_factory.mktemp("server")) as running:
        yield running


def test_files_of_the_page_are_for_all_and_set_no_cookie(server: Server) -> None:
    for path in ("/", "/main.js", "/?token=t"):
        status, headers = server.get(path)
        assert status == 200
        assert "default-src 'self'" in headers["Content-Security-Policy"]
        assert "Set-Cookie" not in headers


@pytest.mark.parametrize("first", ["", "wrong", b"t", None])
def test_a_socket_without_the_token_is_closed(server: Server, first: str | bytes | None) -> None:
    async def closed() -> tuple[WSMsgType, int | None, str | None]:
        async with websocket(server.origin) as socket:
            if isinstance(first, str):
                await socket.send_str(first)
            elif first is not None:
                await socket.send_bytes(first)
            message = await socket.receive(20)
            return message.type, message.data, message.extra

    kind, code, reason = asyncio.run(closed())
    assert kind == WSMsgType.CLOSE
    assert code == 4401
    assert "needs a token" in str(reason)


def test_a_socket_with_the_token_is_a_page(server: Server) -> None:
    async def rights() -> object:
        async with page_client(server.origin) as page:
            return await page.wait_for_event("hello")

    assert asyncio.run(rights()) == {"edit": True}


def test_other_names_and_other_sites_are_refused(server: Server) -> None:
    assert server.get("/", Host=f"attacker.example:{server.port}")[0] == 403
    assert server.get("/", Origin="http://attacker.example")[0] == 403
    assert server.get("/socket", **UPGRADE)[0] == 403  # no Origin
    assert server.get("/socket", Origin="http://127.0.0.1:1", **UPGRADE)[0] == 403
    assert server.get("/socket", Origin=server.origin, **UPGRADE)[0] == 101


def test_what_is_not_a_host_is_refused_without_a_traceback(server: Server) -> None:
    for host in ("[", "[::1", "127.0.0.1:x", ""):
        assert server.get("/", Host=host)[0] == 403
    assert "Traceback" not in server.output


def test_files_outside_of_the_page_are_not_served(server: Server) -> None:
    for path in ("/../package.xml", "/%2e%2e/package.xml", "/..%2f..%2fpackage.xml"):
        assert server.get(path)[0] in (403, 404)


@pytest.mark.parametrize("has_runtime_folder", [True, False])
def test_the_token_is_in_a_file_of_the_owner_and_not_in_the_log(tmp_path: Path, has_runtime_folder: bool) -> None:
    chosen_by_others = (*TOKEN, "XDG_RUNTIME_DIR", "ROS_HOME")
    environment = {name: value for name, value in os.environ.items() if name not in chosen_by_others}
    environment["HOME"] = str(tmp_path)
    if has_runtime_folder:
        environment["XDG_RUNTIME_DIR"] = str(tmp_path)
    with Server(tmp_path, env=environment) as server:
        file = server.address_file
        assert file.parent == tmp_path / ("bubblesim" if has_runtime_folder else ".ros/bubblesim")
        assert str(server.port) in file.name
        assert file.stat().st_mode & 0o777 == 0o600
        assert file.parent.stat().st_mode & 0o777 == 0o700
        found = re.search(rf'href="{server.origin}/#token=([^"]+)"', file.read_text())
        assert found
        assert len(found[1]) >= 32
        assert found[1] not in server.output

        async def rights() -> object:
            async with page_client(server.origin, found[1]) as page:
                return await page.wait_for_event("hello")

        assert asyncio.run(rights()) == {"edit": True}
        stop(server.process)
        assert server.process.returncode == 0
        assert not file.exists()


def test_the_whole_address_is_printed_to_a_terminal(tmp_path: Path) -> None:
    terminal, inside = os.openpty()
    command = ["bubblesim", "view", "--remote", str(free_port()), "--port", str(free_port())]
    server = start(command, os.environ | TOKEN, cwd=tmp_path, stdout=inside, stderr=inside)
    try:
        os.close(inside)
        output = ""
        while "\n" not in output.partition("the window is at")[2]:
            output += os.read(terminal, 4096).decode()
        assert re.search(r"the window is at http://127.0.0.1:\d+/#token=t", output)
    finally:
        stop(server)
        os.close(terminal)


def test_servers_that_begin_together_have_ports_of_their_own(tmp_path: Path) -> None:
    command = ["bubblesim", "view", "--remote", str(free_port())]
    logs = [tmp_path / f"{number}.txt" for number in range(6)]
    servers = []
    with ExitStack() as ends:
        for log in logs:
            with log.open("w") as output:
                servers.append(start(command, dict(os.environ), stderr=output))
                ends.callback(stop, servers[-1])
        wait_until(lambda: all("the window is at" in log.read_text() for log in logs), "all", timeout=TIMEOUT / 1000)
        assert [server.poll() for server in servers] == [None] * len(servers), [log.read_text() for log in logs]
    found = [re.findall(r"the window is at http://127.0.0.1:(\d+)/", log.read_text()) for log in logs]
    assert all(len(ports) == 1 for ports in found), found
    assert len({ports[0] for ports in found}) == len(logs), [log.read_text() for log in logs]


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
            ("sim.checkProximitySensor", [handle, handle]),  # measures
            ("sim.checkVisionSensor", [handle, handle]),
            ("zmqRemoteApi.require", ["sim"]),
            ("server.run", ["sim.startSimulation()"]),
            ("server.run", ["sim.getObjectPosition(sim.checkProximitySensor(1, 2))"]),
            ("server.checkScript", [handle, ""]),
            ("server.saveScript", [handle, "", ""]),
            ("server.saveScene", [str(tmp_path), "scene", True]),
            ("server.drive", ["/cmd_vel", 0, 0, 0]),
            ("server.startRecording", [[]]),
            ("server.stopRecording", []),
        ]:
            answer = page.page.evaluate(
                "([name, args]) => bubblesim.link.call(name, args).then(() => 'done', (error) => error.message)",
                [function, arguments],
            )
            assert "is read-only" in answer
