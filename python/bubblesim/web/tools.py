# SPDX-License-Identifier: BSD-3-Clause
"""The functions of the server for the tools of the page: scripts, console, topics, driving, recording, saving."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

from bubblesim.controllers.base_velocity import BaseVelocity
from bubblesim.web import console, foreign_files, ros_markers, ros_topics, scene_copies, scene_files, script_files
from bubblesim.web.bag_recording import recording
from bubblesim.web.served import Served


async def _watch(page: Any, topic: str, path: str) -> int:
    number: int = await page.topics.watch(topic, path)
    return number


async def _samples(page: Any, number: int, since: int) -> dict[str, Any]:
    found: dict[str, Any] = page.topics.samples(number, since)
    return found


async def _unwatch(page: Any, number: int) -> None:
    await page.topics.unwatch(number)


async def _drive(page: Any, topic: str, forward: float, left: float, turn: float) -> None:
    await page.topics.drive(topic, BaseVelocity(float(forward), float(left), float(turn)))


async def _state(_page: Any) -> dict[str, Any]:
    return recording.state()


async def _start(_page: Any, topics: list[str]) -> dict[str, Any]:
    return await recording.start(topics)


async def _stop(_page: Any) -> dict[str, Any]:
    return await recording.stop()


_LOOKING: dict[str, Callable[..., Awaitable[Any]]] = {
    "server.api": script_files.api,
    "server.readScript": script_files.read,
    "server.run": console.run,  # each of its calls is checked
    "server.topics": ros_topics.topics,
    "server.subscribed": ros_topics.subscribed,
    "server.topicFields": ros_topics.fields,
    "server.watchTopic": _watch,
    "server.topicSamples": _samples,
    "server.unwatchTopic": _unwatch,
    "server.markers": ros_markers.changes,
    "server.endMarkers": ros_markers.end,
    "server.recording": _state,
    "server.sceneFolders": scene_files.folders,
    "server.copyFolders": scene_copies.folders,
}
_EDITING: dict[str, Callable[..., Awaitable[Any]]] = {
    "server.checkScript": script_files.check,
    "server.saveScript": script_files.save,
    "server.saveScene": scene_files.save,
    "server.openCopy": scene_copies.open_copy,
    "server.readForeign": foreign_files.read,
    "server.openForeign": foreign_files.open_scene,
    "server.drive": _drive,
    "server.startRecording": _start,
    "server.stopRecording": _stop,
}

TOOLS = {
    **{name: Served(call, edits=False) for name, call in _LOOKING.items()},
    **{name: Served(call, edits=True) for name, call in _EDITING.items()},
}
